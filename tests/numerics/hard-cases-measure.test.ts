import {
  covariance,
  fitPlane,
  geodesicBetween,
  geodesicFrom,
  geodesicPolygon,
  PlacementError,
  planarArea,
  quantise,
  slab,
  splitFloat32,
  symmetricEigen,
} from "@groma/georef";
import { describe, expect, it } from "vitest";
import { NodeGeometry } from "../../layer/src/cloud/node-geometry.js";
import { type HardCase, missing, named, of, pairs, radians, titled, tolerance } from "./hard-cases.js";

const number = (row: HardCase, name: string) => Number(row.input[name]);
const want = (row: HardCase, name: string) => Number(row.truth[name]);
const degrees = (angle: number) => (angle * 180) / Math.PI;

describe.skipIf(missing)(titled("hard cases of measuring at their own tolerance"), () => {
  describe("geodesics", () => {
    it.each(named(of("geodesic inverse")))("%s", (_, row) => {
      const [lon1, lat1, lon2, lat2] = ["lon1", "lat1", "lon2", "lat2"].map((name) =>
        radians(number(row, name)),
      );
      const { distance } = geodesicBetween(lon1, lat1, lon2, lat2);
      expect(Math.abs(distance - want(row, "s12_m"))).toBeLessThanOrEqual(tolerance(row));
    });

    it.each(named(of("geodesic direct")))("%s", (_, row) => {
      const [lon1, lat1, azimuth] = ["lon1", "lat1", "azi1"].map((name) => radians(number(row, name)));
      const { longitude, latitude } = geodesicFrom(lon1, lat1, azimuth, number(row, "s12"));
      expect(Math.abs(degrees(latitude) - want(row, "lat2"))).toBeLessThanOrEqual(tolerance(row));
      expect(Math.abs(degrees(longitude) - want(row, "lon2"))).toBeLessThanOrEqual(tolerance(row));
    });

    it.each(named(of("geodesic polygon")))("%s", (_, row) => {
      const ring = pairs(row.input.latlon).flatMap(([latitude, longitude]) => [
        radians(longitude),
        radians(latitude),
      ]);
      const { perimeter, area } = geodesicPolygon(ring);
      expect(Math.abs(area - want(row, "area_m2"))).toBeLessThanOrEqual(tolerance(row));
      expect(Math.abs(perimeter - want(row, "perimeter_m"))).toBeLessThanOrEqual(1e-6);
    });
  });

  describe("the plane", () => {
    it.each(named(of("planar shoelace")))("%s", (_, row) => {
      const area = planarArea(pairs(row.input.xy).flat());
      expect(Math.abs(area - want(row, "area"))).toBeLessThanOrEqual(tolerance(row));
    });

    it.each(named(of("slab")))("%s", (_, row) => {
      const { a, b, point } = row.input as Record<string, [number, number]>;
      const { contains, along, across } = slab(...a, ...b, number(row, "half_width"));
      expect(contains(...point)).toBe(row.truth.inside);
      expect(Math.abs(Math.abs(across(...point)) - want(row, "distance"))).toBeLessThanOrEqual(
        tolerance(row, "distance"),
      );
      expect(along(...point)).toBeCloseTo(want(row, "t"), 12);
    });
  });

  describe("covariance", () => {
    it.each(named(of("covariance")))("%s", (_, row) => {
      const points = (row.input.points as number[][]).flat();
      const { matrix } = covariance(points);
      const { values } = symmetricEigen(matrix);
      const [least, middle, greatest] = row.truth.eigenvalues as [number, number, number];
      const close = tolerance(row, "abs_rel_to_l3") * greatest;
      for (const [i, value] of (row.truth.cov as number[][]).flat().entries()) {
        expect(Math.abs(matrix[i] - value)).toBeLessThanOrEqual(close);
      }
      for (const [i, value] of [least, middle, greatest].entries()) {
        expect(Math.abs(values[i] - value)).toBeLessThanOrEqual(close);
      }
      const relative = (row.tolerance as Record<string, number | null>).l1_rel;
      if (relative !== null) expect(Math.abs(values[0] - least)).toBeLessThanOrEqual(relative * least);
      const { deviation, normal } = fitPlane(points);
      expect(Math.abs(deviation ** 2 - least)).toBeLessThanOrEqual(close);
      expect(Math.hypot(...normal)).toBeCloseTo(1, 14);
    });
  });

  describe("quantisation", () => {
    /** What a case asks for, by the names of its truth. */
    const CHECKS: Readonly<Record<string, (row: HardCase) => void>> = {
      q: (row) =>
        expect(quantise(number(row, "x"), number(row, "scale"), number(row, "offset"))).toBe(row.truth.q),
      overflow: (row) => {
        const task = () => quantise(number(row, "x"), number(row, "scale"), number(row, "offset"), row.name);
        expect(task).toThrow(PlacementError);
        expect(task).toThrow("PLACE_RANGE");
      },
      f32: (row) => {
        const x = number(row, "x");
        const stored = Float32Array.of(x)[0];
        expect(stored).toBe(row.truth.f32);
        if (row.truth.err !== undefined) expect(stored - x).toBeCloseTo(want(row, "err"), 12);
      },
      high: (row) => {
        const [high, low] = splitFloat32(number(row, "x"));
        expect([high, low]).toEqual([row.truth.high, row.truth.low]);
        expect(Math.abs(high + low - number(row, "x"))).toBeLessThanOrEqual(tolerance(row));
      },
      edge: (row) => {
        const size = number(row, "L");
        const boundingBox = { min: [0, 0, 0], max: [size, size, size] } as const;
        const geometry = new NodeGeometry(
          { boundingBox, cube: [0, 0, 0, size], spacing: 1 },
          () => undefined,
          {
            horizontalUnit: { name: "metre", kind: "linear", size: 1 },
          },
        );
        const [, , , edge] = geometry.cube({ depth: number(row, "levels"), x: 0, y: 0, z: 0 });
        expect(edge).toBe(row.truth.edge);
      },
    };
    it.each(named(of("quantisation")))("%s", (_, row) => {
      const checks = Object.keys(CHECKS).filter((name) => row.truth[name] !== undefined);
      expect(checks.length).toBe(1);
      CHECKS[checks[0]](row);
    });
  });
});
