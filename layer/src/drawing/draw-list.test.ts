import { describe, expect, it } from "vitest";
import { DrawList } from "./draw-list.js";
import { PointDraws } from "./point-draws.js";
import { attributeSet } from "./vertex-attributes.js";

/** A context that notes which node each draw is of, as the program in use would know it, and which vertices. */
function context(many: boolean) {
  const drawn: { array: string; row: number; first: number; count: number }[] = [];
  let calls = 0;
  let [array, row] = ["", 0];
  const draw = (first: number, count: number, id = 0) =>
    void drawn.push({ array, row: row + id, first, count });
  const gl = {
    POINTS: 0,
    getSupportedExtensions: () => (many ? ["WEBGL_multi_draw"] : []),
    getExtension: () => (many ? { multiDrawArraysWEBGL } : null),
    drawArrays: (_: number, first: number, count: number) => {
      calls++;
      draw(first, count);
    },
  };
  function multiDrawArraysWEBGL(...given: [number, Int32Array, number, Int32Array, number, number]) {
    const [, firsts, firstAt, counts, countAt, draws] = given;
    calls++;
    for (let id = 0; id < draws; id++) draw(firsts[firstAt + id]!, counts[countAt + id]!, id);
  }
  const binding = {
    bind: (next: string) => {
      array = next;
    },
    number: (next: number) => {
      row = next;
    },
  };
  const draws = new PointDraws(gl as unknown as WebGL2RenderingContext);
  draws.enable();
  return { drawn, binding, draws, calls: () => calls };
}

const READS = attributeSet([]);
const node = (row: number, array: string, first: number, count: number) => ({
  ...{ row, count },
  uploaded: { first, arrayOf: () => array },
});
/** Nodes of two pages, one of another kind among those of the first, and one that is not drawn. */
const NODES = [
  node(0, "a", 0, 10),
  node(1, "a", 30, 7),
  node(2, "b", 10, 20),
  node(3, "a", 37, 1),
  node(5, "a", 40, 2),
  node(6, "c", 0, 9),
];

describe.each([
  [true, 5],
  [false, 6],
])("a list of draws, many in a call: %s", (many, calls) => {
  it("draws exactly its nodes, each by its row and its vertices", () => {
    const { drawn, binding, draws, calls: made } = context(many);
    const list = new DrawList<string>();
    list.fill(NODES, READS);
    draws.draw(list, binding);
    const wanted = NODES.map(({ row, count, uploaded }) => ({
      ...{ array: uploaded.arrayOf(), row, first: uploaded.first, count },
    }));
    expect(drawn).toEqual(wanted);
    expect(made()).toBe(calls);
    expect(draws.many).toBe(many);
  });

  it("draws copies by the rows that follow, and nothing of what it had before", () => {
    const { drawn, binding, draws } = context(many);
    const list = new DrawList<string>();
    list.fill(
      Array.from({ length: 500 }, (_, row) => node(row, "a", row, 1)),
      READS,
    );
    list.fill(NODES.slice(1, 3), READS);
    draws.draw(list, binding, 100);
    expect(drawn).toEqual([
      { array: "a", row: 101, first: 30, count: 7 },
      { array: "b", row: 102, first: 10, count: 20 },
    ]);
    list.clear();
    draws.draw(list, binding);
    expect(drawn).toHaveLength(2);
  });
});
