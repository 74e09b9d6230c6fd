import { describe, expect, it } from "vitest";
import { EGM96 } from "../vertical/egm96.js";
import { accuracyParts, EGM96_ACCURACY, similarityParts, statedAccuracy } from "./accuracy.js";

const METRE = { name: "metre", kind: "linear", size: 1 } as const;
const crs = (height: Parameters<typeof accuracyParts>[0]["height"]) => ({
  ...{ horizontalUnit: METRE, verticalUnit: { ...METRE, declared: true }, height },
});
const geoid = crs({ kind: "geoid", model: "NAP height", epsg: 5709 });
const operation = { name: "Amersfoort to ETRS89 (9)", accuracy: 0.001, ballpark: false };
const scale = [0.001, 0.001, 0.001];

const part = (parts: ReturnType<typeof accuracyParts>, name: string) =>
  parts.find((one) => one.name === name);

describe("accuracy by an engine", () => {
  it("counts a geoid by its grid with the operation", () => {
    const parts = accuracyParts(geoid, scale, 0.001, { operation, geoids: ["nl_nsgi_nlgeo2018.tif"] });
    expect(part(parts, "height")).toMatchObject({ metres: 0, note: expect.stringContaining("nlgeo2018") });
    expect(part(parts, "datum operation")).toMatchObject({ metres: 0.001, note: operation.name });
    expect(statedAccuracy(parts).total).toBeCloseTo(0.002 + 0.0005 * Math.sqrt(3), 12);
  });

  it("says what EGM96 is worth in its place", () => {
    const parts = accuracyParts(geoid, scale, 0.001, { operation, geoids: [EGM96] });
    expect(part(parts, "height")?.metres).toBe(EGM96_ACCURACY);
  });

  it("does not know what heights are worth where their system is not in use", () => {
    const placing = { operation, geoids: [EGM96], outsideOf: "NAP height" };
    const parts = accuracyParts(geoid, scale, 0.001, placing);
    expect(part(parts, "height")).toMatchObject({
      metres: null,
      note: "NAP height: not in use at this place",
    });
  });

  it("carries the guess of an unknown height, and stays unknown", () => {
    const guess = "if the heights are above sea level, the points should be 22 m lower";
    const parts = accuracyParts(crs({ kind: "unknown" }), scale, 0.001, { operation, geoids: [], guess });
    expect(part(parts, "height")).toEqual({ name: "height", metres: null, note: guess });
    expect(statedAccuracy(parts).total).toBeNull();
  });

  it("does not believe an operation that passes a datum over", () => {
    const placing = { operation: { ...operation, ballpark: true }, geoids: [] };
    expect(part(accuracyParts(geoid, scale, 0.001, placing), "datum operation")?.metres).toBeNull();
  });

  it("says that heights are drawn without their geoid where no engine has run", () => {
    expect(part(accuracyParts(geoid, scale, 0.001), "height")).toMatchObject({ metres: null });
  });
});

describe("accuracy of a similarity", () => {
  it("is that of its control points, or not known", () => {
    const control = { residuals: [0.01, 0.02, 0.01], rms: 0.0141, max: 0.02 };
    const parts = similarityParts(crs({ kind: "ellipsoidal" }), scale, 0.001, control);
    expect(part(parts, "control points")).toMatchObject({
      metres: 0.02,
      note: expect.stringContaining("0.0141"),
    });
    expect(statedAccuracy(similarityParts(crs({ kind: "ellipsoidal" }), scale, 0.001)).total).toBeNull();
  });
});
