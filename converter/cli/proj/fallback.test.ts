import {
  type Crs,
  compileTransformation,
  cutWindow,
  type Domain,
  ecefToGeodetic,
  exactTransform,
  guessHeight,
  resolveCrs,
} from "@groma/georef";
import { describe, expect, it } from "vitest";
import { egm96 } from "./egm96.js";
import { proj4jsTransformation } from "./fallback.js";
import { findProj } from "./program/find.js";
import { projTransformation } from "./transformation.js";

const proj = await findProj();
const absent = proj ? "" : " (skipped: PROJ is not installed)";
const DEGREE = Math.PI / 180;

const RD =
  "+proj=sterea +lat_0=52.1561605555556 +lon_0=5.38763888888889 +k=0.9999079 +x_0=155000 +y_0=463000 +ellps=bessel +towgs84=565.4171,50.3319,465.5524,-0.398957388243134,0.343987817378283,-1.87740163998045,4.0725 +units=m";
const OREGON =
  "+proj=lcc +lat_0=41.75 +lon_0=-120.5 +lat_1=43 +lat_2=45.5 +x_0=399999.9999984 +y_0=0 +ellps=GRS80 +towgs84=0,0,0 +units=ft";

function crsOf(given: string, height?: Crs["height"]): Crs {
  const crs = resolveCrs({ file: "scan.las", given });
  return height ? { ...crs, height } : crs;
}

function box(minX: number, minY: number): Domain {
  return { minX, minY, minZ: 0, maxX: minX + 5000, maxY: minY + 5000, maxZ: 300 };
}

describe("without PROJ", () => {
  it("heights above a geoid go by EGM96, with what that is worth in words", async () => {
    const height = { kind: "geoid", model: "NAP height" } as const;
    const { transformation, report } = await proj4jsTransformation(crsOf(RD, height), box(150_000, 450_000));
    expect(transformation.steps.map(({ kind }) => kind)).toEqual([
      ...["projection", "datumShift", "verticalShift", "geocentric"],
    ]);
    expect(report).toMatchObject({ engine: { name: "proj4js" }, accuracy: null, grids: ["EGM96"] });
    expect(report.notes.join()).toMatch(/decimetres.*about 4 m/);
  });

  it("an unknown height stays unknown", async () => {
    const { transformation, report } = await proj4jsTransformation(crsOf(OREGON), box(600_000, 1_000_000));
    expect(report.grids).toEqual([]);
    expect(report.notes.join()).toMatch(/height reference unknown/);
    expect(transformation.steps).toContainEqual({ kind: "height", metresPerUnit: 0.3048 });
  });

  it("heights above the ellipsoid of the datum move with its shift, those above WGS 84 do not", async () => {
    const domain = box(150_000, 450_000);
    const kinds = [{ kind: "ellipsoidal", ellipsoid: "own" }, { kind: "ellipsoidal" }] as const;
    for (const height of kinds) {
      const crs = crsOf(RD, height);
      const { transformation } = await proj4jsTransformation(crs, domain);
      const [a, b] = [new Float64Array(3), new Float64Array(6)];
      compileTransformation(transformation).evaluate(152_000, 452_000, 0, a, 0);
      exactTransform(crs)(152_000, 452_000, b, 0);
      expect(Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2])).toBeLessThan(2e-4);
      const geodetic = new Float64Array(3);
      ecefToGeodetic(a[0], a[1], a[2], geodetic);
      expect(geodetic[2]).toBeCloseTo(height === kinds[0] ? 43.3 : 0, 0);
    }
  });

  it.skipIf(!proj).each([
    ["RD", RD, box(150_000, 450_000)],
    ["Oregon", OREGON, box(600_000, 1_000_000)],
  ])(`the place is PROJ's for the same string: %s${absent}`, async (_, text, domain) => {
    const crs = crsOf(text);
    const [own, truth] = [
      await proj4jsTransformation(crs, domain),
      await projTransformation(proj!, crs, domain, { text }),
    ].map(({ transformation }) => compileTransformation(transformation));
    const [a, b] = [new Float64Array(3), new Float64Array(3)];
    for (const [u, v] of [
      [0, 0],
      [1, 0.3],
      [0.5, 1],
    ]) {
      const point = [domain.minX + u * 5000, domain.minY + v * 5000, 100] as const;
      own.evaluate(...point, a, 0);
      truth.evaluate(...point, b, 0);
      expect(Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2])).toBeLessThan(2e-4);
    }
  });
});

describe("EGM96", () => {
  it("has its nodes where the model has them, across the antimeridian too", async () => {
    const window = cutWindow(await egm96(), {
      west: 179.6 * DEGREE,
      east: 180.3 * DEGREE,
      south: -17.2 * DEGREE,
      north: -16.9 * DEGREE,
    });
    expect(window.stepLongitude).toBeCloseTo(0.25 * DEGREE, 15);
    expect(window.columns * window.rows).toBeLessThan(60);
    expect(Math.min(...window.values)).toBeGreaterThan(45);
    expect(Math.max(...window.values)).toBeLessThan(60);
  });

  it.each([
    [0, 0, 17.16],
    [15, 50, 44.8],
    [-75, 10, -4.78],
    [78, 3, -103.47],
    [375, 50, 44.8],
    [0, 90, 13.61],
  ])("stands at %d°, %d° by %d m", async (longitude, latitude, expected) => {
    const { undulation, note } = guessHeight(
      await egm96(),
      [],
      crsOf(OREGON),
      longitude * DEGREE,
      latitude * DEGREE,
    );
    expect(Math.abs(undulation - expected)).toBeLessThan(0.05);
    expect(note).toContain(`${Math.abs(undulation).toFixed(1)} m ${undulation < 0 ? "lower" : "higher"}`);
  });
});
