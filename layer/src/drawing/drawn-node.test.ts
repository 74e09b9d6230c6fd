import { describe, expect, it } from "vitest";
import { pointOf } from "./drawn-node.js";

const nodes = [
  { firstId: 0, count: 3 },
  { firstId: 3, count: 1 },
  { firstId: 4, count: 10 },
];

describe("pointOf", () => {
  it.each([
    [0, 0, 0],
    [2, 0, 2],
    [3, 1, 0],
    [4, 2, 0],
    [13, 2, 9],
  ])("number %s is node %s's point %s", (id, node, index) =>
    expect(pointOf(nodes, id)).toEqual({ drawn: nodes[node], index }),
  );

  it("is nothing beyond the last", () => {
    expect(pointOf(nodes, 14)).toBeUndefined();
    expect(pointOf([], 0)).toBeUndefined();
  });
});
