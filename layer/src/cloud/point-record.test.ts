import { describe, expect, it } from "vitest";
import { extraBytes, randomNumbers, randomRecords } from "../workers/record.fixture.js";
import { pointRecord } from "./point-record.js";

/** Names that all objects have something under. */
const INHERITED = ["__proto__", "constructor", "toString"];

const { attributes } = randomRecords(
  6,
  5,
  extraBytes(...INHERITED.map((name) => ({ name, type: "uint16" as const }))),
  randomNumbers(4),
);
const xyz = Int32Array.from({ length: 15 }, (_, index) => index);
const placed = { scale: [0.5, 1, 1], offset: [10, 0, 0] } as const;

describe("pointRecord", () => {
  it("reads one point's integers and attributes", () => {
    const {
      node,
      index,
      integers,
      source,
      attributes: read,
    } = pointRecord("0-0-0-0", 2, { xyz, attributes }, placed);
    expect([node, index, integers, source]).toEqual(["0-0-0-0", 2, [6, 7, 8], [13, 7, 8]]);
    const intensity = attributes.find(({ name }) => name === "intensity")!;
    const at = intensity.at + 2 * intensity.stride;
    expect(read.intensity).toBe(intensity.bytes[at] | (intensity.bytes[at + 1] << 8));
  });

  it("has attributes under names that objects inherit, and nothing under those that are not there", () => {
    const { attributes: read } = pointRecord("0-0-0-0", 0, { xyz, attributes }, placed);
    expect(Object.keys(read).slice(-3)).toEqual(INHERITED);
    for (const name of INHERITED) expect(read[name], name).toBeTypeOf("number");
    expect(read.valueOf).toBeUndefined();
    expect(Object.keys(Object.prototype)).toEqual([]);
  });
});
