import type { Crs } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { accuracyWords, counted, countWords, crsWords, heightWords, lengthWords } from "./words.js";

const foot = { name: "foot", kind: "linear", size: 0.3048 } as const;
const crs = (height: Crs["height"], declared = true) => ({ height, verticalUnit: { ...foot, declared } });

describe("numbers in words", () => {
  it("groups counts by thousands", () => {
    expect(countWords(10_653_336)).toBe("10,653,336");
    expect(counted(1, "node")).toBe("1 node");
    expect(counted(0, "node")).toBe("0 nodes");
  });

  it.each([
    [null, "not known"],
    [Number.NaN, "not known"],
    [0, "0 mm"],
    [0.001, "1 mm"],
    [0.00000012, "0.00012 mm"],
    [0.000871, "0.88 mm"],
    [0.00999, "10 mm"],
    [0.07, "7 cm"],
    [0.29, "29 cm"],
    [0.291, "30 cm"],
    [1, "1 m"],
    [1.21, "1.3 m"],
    [123, "130 m"],
  ])("writes %s metres as %s, never rounded down", (metres, words) => {
    expect(lengthWords(metres)).toBe(words);
  });
});

describe("a cloud in words", () => {
  it("says so when the coordinate system has no code", () => {
    const file = { given: false };
    expect(crsWords({ name: "A", code: "EPSG:2056" }, file)).toEqual({ text: "A", note: "EPSG:2056" });
    expect(crsWords({ name: "A" }, file).note).toBe("no code named");
    expect(crsWords({ name: "A" }, { given: true }).note).toBe(
      "no code named; given by you, not by the file",
    );
  });

  it("never guesses a height reference", () => {
    const drawn = { applied: false };
    expect(heightWords(crs({ kind: "ellipsoidal" }), drawn)).toEqual({ text: "above the ellipsoid" });
    expect(heightWords(crs({ kind: "unknown" }), drawn)).toEqual({
      text: "unknown",
      note: "drawn as ellipsoidal",
    });
    expect(heightWords(crs({ kind: "unknown" }, false), drawn).note).toBe(
      "drawn as ellipsoidal; unit not declared, taken as foot",
    );
    expect(heightWords(crs({ kind: "geoid", model: "LN02 height", epsg: 5728 }), drawn)).toEqual({
      text: "above the geoid: LN02 height (EPSG:5728)",
      note: "its geoid is not applied, drawn as ellipsoidal",
    });
    expect(heightWords(crs({ kind: "geoid", model: "NAVD88" }), { applied: true }).note).toBe(
      "its geoid is applied",
    );
  });

  it("sums an accuracy only when every part is known", () => {
    const placing = { name: "placing", metres: 0.001 };
    const height = { name: "height", metres: null };
    expect(accuracyWords({ total: 0.001, parts: [placing] }).text).toBe("1 mm");
    expect(accuracyWords({ total: null, parts: [placing, height] })).toEqual({
      text: "not known",
      note: "1 mm without height",
    });
  });
});
