import {
  compileTransformation,
  cutWindow,
  ecefToGeodetic,
  exactTransform,
  fitPatchwork,
  geodeticToEcef,
  PlacementError,
  placePoint,
  resolveCrs,
  undulationOf,
  WGS84,
} from "@groma/georef";
import { describe, expect, it } from "vitest";
import { lookup } from "../../georef/src/crs/epsg-table.fixture.js";
import { samplerOf } from "../../georef/src/transformation/sampler.fixture.js";
import { data } from "../project.js";
import {
  distance,
  FAMILIES,
  type HardCase,
  missing,
  named,
  of,
  radians,
  rows,
  titled,
  tolerance,
  triple,
} from "./hard-cases.js";
import { missingFor, openGrid, PIPELINES, pipeline } from "./pipelines.js";

const METRE = { name: "metre", kind: "linear", size: 1 } as const;

const EGM96 = "us_nga_egm96_15.tif";
const egm96Missing = data(`grids/${EGM96}`).missing;
const WORLD = { west: -Math.PI, south: -Math.PI / 2, east: Math.PI, north: Math.PI / 2 };

/** A square of 200 m around a point. */
const around = ([x, y]: readonly number[]) => ({
  minX: x - 100,
  minY: y - 100,
  maxX: x + 100,
  maxY: y + 100,
});

describe.skipIf(missing)(titled("hard cases of place at their own tolerance"), () => {
  it("belong to one family each", () => {
    const counts = rows.map(({ name }) => FAMILIES.filter((family) => name.startsWith(family)).length);
    expect(counts.every((count) => count === 1)).toBe(true);
    expect(rows.length).toBe(95);
  });

  describe("ECEF → geodetic", () => {
    const out = new Float64Array(3);
    const back = new Float64Array(3);
    it.each(named(of("ECEF->geodetic")))("%s", (_, row) => {
      const xyz = triple(row.input.xyz);
      ecefToGeodetic(...xyz, out);
      geodeticToEcef(out[0], out[1], out[2], back);
      expect(distance(back, xyz)).toBeLessThanOrEqual(tolerance(row));
      expect(Math.abs(out[2] - Number(row.truth.h))).toBeLessThanOrEqual(tolerance(row));
      // Latitude as a length on the sphere of the point; of two nearest points inside the evolute either may be it.
      const mirrored = xyz[2] === 0 ? Math.abs(out[1]) - Math.abs(radians(Number(row.truth.lat))) : undefined;
      const off = mirrored ?? out[1] - radians(Number(row.truth.lat));
      expect(Math.abs(off) * Math.hypot(...xyz)).toBeLessThanOrEqual(tolerance(row));
    });
  });

  describe("transverse Mercator, exact", () => {
    const out = new Float64Array(3);
    const want = new Float64Array(3);
    // The sixth-order series of proj4js (and PROJ) leaves the exact projection beyond 50° from the meridian: refused there.
    const series = (row: HardCase) => Number(row.input.lon) - 15 > 50;
    it.each(named(of("TM exact").filter((row) => !series(row))))("%s", (_, row) => {
      const crs = resolveCrs({ file: row.name, given: String(row.input.crs) }, lookup);
      placePoint(exactTransform(crs), Number(row.truth.x), Number(row.truth.y), 0, out);
      geodeticToEcef(radians(Number(row.input.lon)), radians(Number(row.input.lat)), 0, want);
      expect(distance(out, want)).toBeLessThanOrEqual(tolerance(row));
    });
    it.each(named(of("TM exact").filter(series)))("%s: refused by name", (_, row) => {
      const crs = resolveCrs({ file: row.name, given: String(row.input.crs) }, lookup);
      const place = () => placePoint(exactTransform(crs), Number(row.truth.x), Number(row.truth.y), 0, out);
      expect(place).toThrow(PlacementError);
      expect(place).toThrow("PLACE_DOMAIN");
    });
  });

  describe("Lambert azimuthal equal area", () => {
    const out = new Float64Array(3);
    const want = new Float64Array(3);
    it.each(named(of("LAEA")))("%s", (_, row) => {
      const crs = resolveCrs({ file: row.name, given: String(row.input.crs) }, lookup);
      const [x, y] = row.input.xy as [number, number];
      placePoint(exactTransform(crs), x, y, 0, out);
      geodeticToEcef(radians(Number(row.truth.lon)), radians(Number(row.truth.lat)), 0, want);
      expect(distance(out, want)).toBeLessThanOrEqual(tolerance(row));
    });
  });

  describe("reprojection to ECEF", () => {
    const out = new Float64Array(3);
    it.each(named(of("reprojection").filter((row) => row.input.proj)))("%s", (_, row) => {
      const crs = resolveCrs({ file: row.name, given: String(row.input.proj) });
      placePoint(exactTransform(crs), ...triple(row.input.xyz), out);
      expect(distance(out, triple(row.truth.xyz))).toBeLessThanOrEqual(tolerance(row));
    });

    // PROJ leaves z of a 2D CRS alone, and takes it as metres; a scan's z is in the unit of its plane.
    const twoDimensional = of("reprojection").filter((row) =>
      ["EPSG:2994", "EPSG:2263"].includes(String(row.input.crs)),
    );
    it.each(named(twoDimensional))("%s", (_, row) => {
      const crs = resolveCrs({ file: row.name, given: String(row.input.crs) }, lookup);
      const metric = { ...crs, verticalUnit: { ...METRE, declared: true } };
      const xyz = triple(row.input.xyz);
      placePoint(exactTransform(metric, xyz[2]), ...xyz, out);
      expect(distance(out, triple(row.truth.xyz))).toBeLessThanOrEqual(tolerance(row));
    });

    const compound = (code: string) =>
      named(of("reprojection").filter((row) => String(row.input.crs) === code));

    describe("with grids", () => {
      const reason = (text: string | undefined) => (text === undefined ? "" : ` (skipped: ${text})`);
      const dutch = missingFor("EPSG:7415");
      it.skipIf(dutch).each(compound("EPSG:7415"))(`%s${reason(dutch)}`, async (_, row) => {
        const xyz = triple(row.input.xyz);
        const compiled = compileTransformation(await pipeline("EPSG:7415", around(xyz)), row.name);
        compiled.forward(...xyz, out);
        expect(distance(out, triple(row.truth.xyz))).toBeLessThanOrEqual(tolerance(row));
      });

      it.skipIf(egm96Missing).each(compound("EPSG:32633+5773"))(
        `%s${reason(egm96Missing)}`,
        async (_, row) => {
          const xyz = triple(row.input.xyz);
          const sample = samplerOf("+proj=utm +zone=33 +ellps=WGS84");
          const patchwork = await fitPatchwork(sample, around(xyz), undefined, WGS84, row.name);
          const window = cutWindow(await openGrid(EGM96), WORLD);
          const { forward } = compileTransformation({
            steps: [
              { kind: "projection", patchwork },
              { kind: "verticalShift", multiplier: 1, window },
              { kind: "geocentric", ellipsoid: WGS84 },
            ],
          });
          forward(...xyz, out);
          expect(distance(out, triple(row.truth.xyz))).toBeLessThanOrEqual(tolerance(row));
        },
      );

      const ours = Object.keys(PIPELINES);
      const others = of("reprojection").filter(
        ({ input }) =>
          !input.proj && !["EPSG:2994", "EPSG:2263", "EPSG:32633+5773", ...ours].includes(String(input.crs)),
      );
      it.skip.each(named(others))("%s (skipped: its grids are not in ../shared/data)", () => undefined);
    });
  });

  describe("units", () => {
    it.each(named(of("unit trap")))("%s", (_, row) => {
      if (row.input.crs) {
        const { verticalUnit } = resolveCrs({ file: row.name, given: String(row.input.crs) }, lookup);
        expect(verticalUnit.declared).toBe(true);
        expect(Number(row.input.z) * verticalUnit.size).toBeCloseTo(Number(row.truth.z_m), 9);
        return;
      }
      const unit = (code: string) => resolveCrs({ file: row.name, given: code }, lookup).horizontalUnit.size;
      const difference = Number(row.input.x_ft) * (unit("EPSG:2263") - unit("EPSG:2994"));
      expect(Math.abs(difference - Number(row.truth.diff_m))).toBeLessThanOrEqual(1e-9);
    });
  });

  describe("geoid EGM96", () => {
    it.skipIf(egm96Missing).each(named(of("EGM96")))(
      `%s${egm96Missing ? ` (skipped: ${egm96Missing})` : ""}`,
      async (_, row) => {
        const undulation = undulationOf(cutWindow(await openGrid(EGM96), WORLD));
        const n = undulation(radians(Number(row.input.lon)), radians(Number(row.input.lat)));
        // PROJ gave this truth by the same grid; the tolerance of the table is that of models rounded to a centimetre.
        expect(Math.abs(n - Number(row.truth.N))).toBeLessThanOrEqual(1e-6);
      },
    );
  });
});
