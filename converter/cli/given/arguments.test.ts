import { describe, expect, it } from "vitest";
import { attributeRanges, returnKinds } from "./arguments.js";

describe("what of the points is kept", () => {
  it("is a range of each attribute, whose names may have anything in them", () => {
    expect(attributeRanges("intensity=0,500")).toEqual([["intensity", 0, 500]]);
    const two = attributeRanges("a=b c=-1.5,1e3", [["intensity", 0, 500]]);
    expect(two).toEqual([
      ["intensity", 0, 500],
      ["a=b c", -1.5, 1000],
    ]);
    for (const text of [
      "intensity",
      "=1,2",
      "intensity=5,1",
      "intensity=1",
      "intensity=1,2,3",
      "intensity=a,b",
    ]) {
      expect(() => attributeRanges(text), text).toThrow();
    }
    expect(() => attributeRanges("intensity=1,2", two)).toThrow("has a range already");
  });

  it("is some kinds of returns", () => {
    expect(returnKinds("first, LAST")).toEqual(["first", "last"]);
    expect(() => returnKinds("first,second")).toThrow("Expected first, last, intermediate, single");
  });
});
