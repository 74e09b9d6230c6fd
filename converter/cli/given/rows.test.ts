import { describe, expect, it } from "vitest";
import { parseRows, type RowFormat } from "./rows.js";

const format: RowFormat = { kind: "POINTS", columns: "x y z", fewest: 2, most: 3 };
const parse = (text: string) => parseRows(text, "points.txt", format);

describe("lines of numbers", () => {
  it("may be separated by spaces, commas, semicolons and tabs, with remarks and empty lines", () => {
    const text = "\uFEFF# x y z\r\n1 2 3\n\n-1.5,2e3 , +.5\r4;\t5 # no height\n6\t7\t8.\n";
    expect(parse(text)).toEqual([
      { line: 2, values: [1, 2, 3] },
      { line: 4, values: [-1.5, 2000, 0.5] },
      { line: 5, values: [4, 5] },
      { line: 6, values: [6, 7, 8] },
    ]);
  });

  it.each([
    ["1 2 3\n1 2 three", 'line 2: "three" is no number'],
    ["1,,2", 'line 1: "" is no number'],
    ["1 2 3,", 'line 1: "" is no number'],
    ["1 2 0x10", 'line 1: "0x10" is no number'],
    ["1 2 Infinity", 'line 1: "Infinity" is no number'],
    ["1 2 1e999", 'line 1: "1e999" is no number'],
    ["# only x\n1", "line 2: expected 2 or 3 numbers, found 1"],
    ["1 2 3 4", "line 1: expected 2 or 3 numbers, found 4; use a decimal point"],
  ])("%j are refused with their line", (text, cause) => {
    expect(() => parse(text)).toThrow(
      expect.objectContaining({ code: "POINTS_SYNTAX", file: "points.txt", cause }),
    );
  });
});
