import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { FormatError } from "../../errors/index.js";
import { entriesOfPage, type HierarchyLimits } from "./hierarchy.js";
import { pageBytes } from "./tiny-copc.fixture.js";

const limits: HierarchyLimits = {
  file: "a.copc.laz",
  fileSize: 10_000,
  pointsOffset: 600,
  pointCount: 1000,
  recordLength: 30,
};

const parse = (...rows: number[][]) => [...entriesOfPage(pageBytes(rows), limits)];

describe("entriesOfPage", () => {
  it("reads nodes, empty nodes and references to pages", () => {
    const entries = parse([0, 0, 0, 0, 600, 50, 10], [1, 1, 0, 1, 0, 0, 0], [1, 0, 1, 1, 5000, 64, -1]);
    expect(entries.map((entry) => entry.pointCount)).toEqual([10, 0, -1]);
    expect(entries[2]).toMatchObject({ depth: 1, x: 0, y: 1, z: 1, address: { offset: 5000, length: 64 } });
  });

  it.each([
    ["a negative depth", [-1, 0, 0, 0, 600, 50, 10]],
    ["a depth beyond 32-bit coordinates", [32, 0, 0, 0, 600, 50, 10]],
    ["an index outside its level", [1, 2, 0, 0, 600, 50, 10]],
    ["a negative index", [1, 0, -1, 0, 600, 50, 10]],
    ["a negative point count", [0, 0, 0, 0, 600, 50, -2]],
    ["more points than the file", [0, 0, 0, 0, 600, 50, 1001]],
    ["points without bytes", [0, 0, 0, 0, 600, 0, 10]],
    ["points inside the header", [0, 0, 0, 0, 100, 50, 10]],
    ["a page of no entries", [0, 0, 0, 0, 700, 0, -1]],
    ["a page that is cut within an entry", [0, 0, 0, 0, 700, 33, -1]],
    ["a page at the file's start", [0, 0, 0, 0, 0, 32, -1]],
  ])("refuses %s", (_, row) => {
    expect(() => parse(row)).toThrow(expect.objectContaining({ code: "FORMAT_HIERARCHY" }));
  });

  it("refuses a chunk longer than its points can be", () => {
    const huge = { ...limits, fileSize: 1e9 };
    const longest = 2 * 10 * 30 + 2 ** 16;
    expect([...entriesOfPage(pageBytes([[0, 0, 0, 0, 600, longest, 10]]), huge)]).toHaveLength(1);
    expect(() => [...entriesOfPage(pageBytes([[0, 0, 0, 0, 600, longest + 1, 10]]), huge)]).toThrow(
      expect.objectContaining({ code: "FORMAT_HIERARCHY" }),
    );
  });

  it("refuses nodes that together have more bytes than the file", () => {
    const nodes = (count: number) => Array.from({ length: count }, (_, x) => [5, x, 0, 0, 600, 1000, 10]);
    expect(parse(...nodes(10))).toHaveLength(10);
    expect(() => parse(...nodes(11))).toThrow(expect.objectContaining({ code: "FORMAT_HIERARCHY" }));
  });

  it("says that the file is truncated where an entry lies beyond its end", () => {
    for (const row of [
      [0, 0, 0, 0, 9990, 50, 10],
      [0, 0, 0, 0, 9990, 32, -1],
    ]) {
      expect(() => parse(row)).toThrow(expect.objectContaining({ code: "FORMAT_TRUNCATED" }));
    }
  });

  it("gives entries inside the file or a FormatError for any bytes at all", () => {
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 160 }), (bytes) => {
        try {
          for (const { pointCount, address } of entriesOfPage(bytes, limits)) {
            if (pointCount !== 0) expect(address.offset + address.length).toBeLessThanOrEqual(10_000);
          }
        } catch (error) {
          expect(error).toBeInstanceOf(FormatError);
        }
      }),
    );
  });
});
