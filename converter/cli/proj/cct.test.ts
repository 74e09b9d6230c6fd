import { describe, expect, it } from "vitest";
import { readPoints, runPipeline, runProjection } from "./cct.js";
import { findProj } from "./program/find.js";
import { splitPipeline } from "./step-text.js";

const proj = await findProj();
const absent = proj ? "" : " (skipped: PROJ is not installed)";
const SWISS = splitPipeline(
  "+inv +proj=somerc +lat_0=46.9524055555556 +lon_0=7.43958333333333 +x_0=2600000 +y_0=1200000 +ellps=bessel",
);

describe("what cct prints", () => {
  it("is read line by line, NaN where PROJ has no place", () => {
    const text = [
      "# Record 0 TRANSFORMATION ERROR: 2 x 3",
      " (Point outside of projection domain)",
      "",
      " 1.5  -2e1  3 0.0000",
      "     *         *  * *",
      "inf inf inf inf",
      "# Record 4 UNREADABLE: nan 3 4",
      "",
    ].join("\n");
    const none = [Number.NaN, Number.NaN, Number.NaN];
    expect([...readPoints(text, 5, "cct")]).toEqual([...none, 1.5, -20, 3, ...none, ...none, ...none]);
  });

  it.each(["", "1 2 3 4\n1 2 3 4\n1 2 3 4", "Segmentation fault"])(
    "is not believed when it is not as long as the question: %s",
    (text) => {
      expect(() => readPoints(text, 2, "cct")).toThrow(expect.objectContaining({ code: "PROJ_OUTPUT" }));
    },
  );
});

describe.skipIf(!proj)(`cct itself${absent}`, () => {
  it("gives longitude and latitude in radians", async () => {
    const [longitude, latitude] = await runProjection(proj!, SWISS, Float64Array.of(2600000, 1200000));
    expect(longitude * (180 / Math.PI)).toBeCloseTo(7.43958333333333, 12);
    expect(latitude * (180 / Math.PI)).toBeCloseTo(46.9524055555556, 12);
  });

  it("goes on after points that have no place", async () => {
    const points = Float64Array.of(
      2600000,
      1200000,
      Number.NaN,
      0,
      Number.POSITIVE_INFINITY,
      0,
      2600000,
      1200000,
    );
    const places = await runProjection(proj!, SWISS, points);
    expect(places.slice(0, 2)).toEqual(places.slice(6, 8));
    expect(Number.isNaN(places[2]) && Number.isNaN(places[4])).toBe(true);
  });

  it("is refused by name with a grid that is not there", async () => {
    const steps = splitPipeline("+proj=vgridshift +grids=not-there.tif");
    await expect(runPipeline(proj!, steps, new Float64Array(3))).rejects.toMatchObject({
      code: "PROJ_FAILED",
    });
  });

  it("stops when it is told to", async () => {
    const points = new Float64Array(3);
    await expect(runPipeline(proj!, SWISS, points, AbortSignal.abort(new Error("enough")))).rejects.toThrow(
      "enough",
    );
  });
});
