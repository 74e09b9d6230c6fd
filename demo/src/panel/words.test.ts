import type { Crs } from "@groma/georef";
import { describe, expect, it } from "vitest";
import {
  accuracyWords,
  countWords,
  crsWords,
  engineWords,
  heightWords,
  lackingWords,
  lengthWords,
  liftWords,
  warningsOf,
} from "./words.js";

const foot = { name: "foot", kind: "linear", size: 0.3048 } as const;
const crs = (height: Crs["height"], declared = true) => ({ height, verticalUnit: { ...foot, declared } });

const report = {
  name: "RD to ETRS89",
  accuracy: 0.001,
  ballpark: false,
  grids: ["a.tif", "b.tif"],
  lacking: [{ name: "RD to ITRF", accuracy: 0.1, grids: ["c.tif"] }],
  worstDifference: 1e-6,
  notes: ["outside of the grids"],
};

describe("numbers in words", () => {
  it("groups counts by thousands", () => {
    expect(countWords(10_653_336)).toBe("10,653,336");
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
    expect(crsWords({ name: "A" }, file).note).toBe("no code");
    expect(crsWords({ name: "A" }, { given: true }).note).toBe("no code; given by you, not by the file");
  });

  it("never guesses a height reference", () => {
    const none = { geoids: [] };
    expect(heightWords(crs({ kind: "ellipsoidal" }), none)).toEqual({ text: "above the ellipsoid" });
    expect(heightWords(crs({ kind: "unknown" }), none)).toEqual({
      text: "unknown",
      note: "drawn as ellipsoidal",
    });
    expect(heightWords(crs({ kind: "unknown" }, false), none).note).toBe(
      "drawn as ellipsoidal; unit not declared, taken as foot",
    );
  });

  it("passes on what the conversion guessed, once", () => {
    const said = (remark: string) => heightWords(crs({ kind: "unknown" }), { geoids: [], remark }).note;
    const guess = "shown as ellipsoidal; if the heights are above sea level, the points should be 22 m lower";
    expect(said(`unknown: ${guess}`)).toBe(guess);
    expect(said("reference unknown, drawn as ellipsoidal")).toBe("drawn as ellipsoidal");
    const operation = { ...report, notes: [`height unknown: ${guess}`, "another"] };
    expect(warningsOf(operation, { remark: `unknown: ${guess}` })).toMatchObject([{ text: "another" }]);
  });

  it("says above whose ellipsoid, and what is declared and not applied", () => {
    const doubt = "declared as shifted by 25 (Vertical_Shift), which is not applied";
    const said = { text: doubt, translated: true };
    expect(heightWords(crs({ kind: "ellipsoidal", ellipsoid: "own", doubt }), { geoids: [] })).toEqual({
      ...{ text: "above the ellipsoid", note: "that of the system's own datum", doubt: said },
    });
    const geoid = crs({ kind: "geoid", model: "NAP height", doubt });
    expect(heightWords(geoid, { geoids: ["EGM96"] }).doubt).toEqual(said);
  });

  it("names the geoid that is applied, or says that none is", () => {
    const nap = crs({ kind: "geoid", model: "NAP height", epsg: 5709 });
    expect(heightWords(nap, { geoids: ["nl_nsgi_nlgeo2018.tif"] })).toEqual({
      text: "above NAP (EPSG:5709)",
      note: "geoid applied: nl_nsgi_nlgeo2018.tif",
    });
    expect(heightWords(nap, { geoids: [] }).note).toMatch(/^geoid not applied/);
    expect(heightWords(nap, { geoids: ["EGM96"] }).note).toMatch(/EGM96 instead of the national one.* 4 m/);
    const global = crs({ kind: "geoid", model: "EGM96 height", epsg: 5773 });
    expect(heightWords(global, { geoids: ["EGM96"] }).note).toBe("geoid applied: EGM96");
    expect(heightWords(crs({ kind: "geoid", model: "NAVD88" }), { geoids: [] }).text).toBe("above NAVD88");
  });

  it("says what places come from, and what would have been better", () => {
    expect(engineWords({ engine: { name: "PROJ", version: "9.5.0" }, operation: report })).toEqual({
      text: "PROJ 9.5.0",
      note: "stated accuracy 1 mm; grids: a.tif, b.tif",
    });
    expect(lackingWords(report)).toEqual([
      { text: "RD to ITRF", note: "stated accuracy 10 cm; lacks c.tif" },
    ]);
    expect(warningsOf(report).map(({ text }) => text)).toEqual(["outside of the grids"]);
    expect(warningsOf({ ...report, ballpark: true })[0]!.text).toContain("hundreds of metres");
  });

  it("says so where the page derives the places itself, or where they were given", () => {
    const words = (name: "proj4js" | "similarity") =>
      engineWords({ engine: { name, version: "2.22.0" }, operation: undefined });
    expect(words("proj4js")).toEqual({ text: "proj4js 2.22.0", note: "in this page, without grids" });
    expect(words("similarity")).toEqual({ text: "an anchor or control points" });
    expect([lackingWords(undefined), warningsOf(undefined)]).toEqual([[], []]);
  });

  it.each([
    [0, ""],
    [2.5, "Drawn 2.5 m above its position, display only."],
    [-1200, "Drawn 1,200 m below its position, display only."],
  ])("says how far %s m off points are drawn", (offset, words) => {
    expect(liftWords(offset)).toBe(words);
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
