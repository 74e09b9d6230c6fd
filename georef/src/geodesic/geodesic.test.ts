import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { distance } from "../cartesian/points.fixture.js";
import {
  chordPolygon,
  ellipsoid,
  geodesicBetween,
  geodesicFrom,
  geodesicPolygon,
  geodeticToEcef,
  WGS84,
} from "../index.js";

const finite = (min: number, max: number) => fc.double({ min, max, noNaN: true, noDefaultInfinity: true });
const longitude = finite(-Math.PI, Math.PI);
const latitude = finite(-Math.PI / 2, Math.PI / 2);

/** Metres between two places on the ellipsoid, in a straight line. */
function apart(lon1: number, lat1: number, lon2: number, lat2: number): number {
  const points = new Float64Array(6);
  geodeticToEcef(lon1, lat1, 0, points);
  geodeticToEcef(lon2, lat2, 0, points, 3);
  return distance(points.subarray(0, 3), points.subarray(3));
}

/** A star-shaped ring around a place, counter-clockwise; `radii` in metres. */
function star(lon: number, lat: number, radii: readonly number[]): number[] {
  return radii.flatMap((radius, i) => {
    const end = geodesicFrom(lon, lat, (-2 * Math.PI * i) / radii.length, radius);
    return [end.longitude, end.latitude];
  });
}

describe("geodesics", () => {
  it("lead from one end to the other and back, antipodes, poles and antimeridian included", () => {
    fc.assert(
      fc.property(longitude, latitude, longitude, latitude, (lon1, lat1, lon2, lat2) => {
        const there = geodesicBetween(lon1, lat1, lon2, lat2);
        const back = geodesicBetween(lon2, lat2, lon1, lat1);
        const end = geodesicFrom(lon1, lat1, there.azimuthFrom, there.distance);
        expect(apart(end.longitude, end.latitude, lon2, lat2)).toBeLessThanOrEqual(3e-8);
        expect(Math.abs(back.distance - there.distance)).toBeLessThanOrEqual(1.5e-8);
      }),
      { numRuns: 5000 },
    );
  });

  it("are never shorter than the chord, nor longer than half a meridian", () => {
    fc.assert(
      fc.property(longitude, latitude, longitude, latitude, (lon1, lat1, lon2, lat2) => {
        const { distance } = geodesicBetween(lon1, lat1, lon2, lat2);
        expect(distance).toBeGreaterThanOrEqual(apart(lon1, lat1, lon2, lat2) - 1e-8);
        expect(distance).toBeLessThanOrEqual(20003931.4586255);
      }),
      { numRuns: 5000 },
    );
  });

  it("do not see the antimeridian, nor whole turns", () => {
    fc.assert(
      fc.property(finite(-0.1, 0.1), latitude, finite(-0.1, 0.1), latitude, (lon1, lat1, lon2, lat2) => {
        const here = geodesicBetween(lon1, lat1, lon2, lat2).distance;
        const across = geodesicBetween(Math.PI + lon1, lat1, lon2 - Math.PI, lat2).distance;
        const turned = geodesicBetween(lon1 + 4 * Math.PI, lat1, lon2, lat2).distance;
        expect(Math.abs(across - here)).toBeLessThanOrEqual(2e-8);
        expect(Math.abs(turned - here)).toBeLessThanOrEqual(2e-8);
      }),
      { numRuns: 2000 },
    );
  });

  it("on a sphere are arcs of great circles", () => {
    const sphere = ellipsoid(1, 0);
    expect(geodesicBetween(0, 0, 0, Math.PI / 2, sphere).distance).toBeCloseTo(Math.PI / 2, 14);
    expect(geodesicFrom(0, 0, Math.PI / 2, 1, sphere).longitude).toBeCloseTo(1, 14);
  });

  it("say nothing of places beyond a pole", () => {
    expect(geodesicBetween(0, 2, 0, 0).distance).toBeNaN();
    expect(geodesicFrom(0, 2, 0, 1).latitude).toBeNaN();
  });

  it("between coincident points have no length", () => {
    expect(geodesicBetween(1, 0.5, 1, 0.5)).toEqual({
      distance: 0,
      azimuthFrom: expect.any(Number),
      azimuthTo: expect.any(Number),
    });
  });
});

describe("polygons", () => {
  const centre = fc.tuple(
    fc.oneof(longitude, fc.constantFrom(Math.PI, -Math.PI)),
    fc.oneof(latitude, fc.constantFrom(Math.PI / 2, -Math.PI / 2)),
  );
  const shape = fc.array(finite(0.5, 1), { minLength: 3, maxLength: 12 });

  it("change sign with their direction, and do not care which vertex comes first", () => {
    fc.assert(
      fc.property(centre, shape, finite(0, 6), ([lon, lat], radii, exponent) => {
        const ring = star(
          lon,
          lat,
          radii.map((radius) => radius * 10 ** exponent),
        );
        const { area, perimeter } = geodesicPolygon(ring);
        const reversed = Array.from({ length: radii.length }, (_, i) =>
          ring.slice(2 * i, 2 * i + 2),
        ).reverse();
        const other = geodesicPolygon(reversed.flat());
        const shifted = geodesicPolygon([...ring.slice(2), ...ring.slice(0, 2)]);
        // The one that starts elsewhere may count as small where the other does not.
        const tolerance = 0.1 + 1e-9 * area;
        expect(area).toBeGreaterThan(0);
        expect(Math.abs(other.area + area)).toBeLessThanOrEqual(tolerance);
        expect(Math.abs(shifted.area - area)).toBeLessThanOrEqual(tolerance);
        expect(Math.abs(shifted.perimeter - perimeter)).toBeLessThanOrEqual(1e-7 + 1e-9 * perimeter);
      }),
      { numRuns: 2000 },
    );
  });

  it("are the sum of their parts, whatever side of the threshold these lie on", () => {
    fc.assert(
      fc.property(centre, finite(50, 20_000), ([lon, lat], radius) => {
        const ring = star(lon, lat, [radius, radius, radius, radius]);
        const whole = geodesicPolygon(ring).area;
        const halves = [ring.slice(0, 6), [...ring.slice(4), ...ring.slice(0, 2)]];
        const sum = halves.reduce((total, half) => total + geodesicPolygon(half).area, 0);
        expect(Math.abs(sum - whole)).toBeLessThanOrEqual(0.2);
      }),
      { numRuns: 1000 },
    );
  });

  it("of a small square have its area to a ten-thousandth of a square metre, anywhere", () => {
    fc.assert(
      fc.property(centre, finite(0.1, 249), ([lon, lat], half) => {
        const area = geodesicPolygon(star(lon, lat, [half, half, half, half])).area;
        expect(Math.abs(area - 2 * half * half)).toBeLessThanOrEqual(1e-4);
      }),
      { numRuns: 2000 },
    );
  });

  it("are the sums of small triangles, around a pole too, to 2e-11, and to 1e-10 all around their first vertex", () => {
    type Place = readonly [number, number];
    const middle = ([lon1, lat1]: Place, [lon2, lat2]: Place): Place => {
      const { distance, azimuthFrom } = geodesicBetween(lon1, lat1, lon2, lat2);
      const { longitude, latitude } = geodesicFrom(lon1, lat1, azimuthFrom, distance / 2);
      return [longitude, latitude];
    };
    const sum = (a: Place, b: Place, c: Place, halvings: number): number => {
      if (halvings === 0) return chordPolygon([...a, ...b, ...c]).area;
      const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
      const parts = [[a, ab, ca] as const, [ab, b, bc] as const, [ca, bc, c] as const, [ab, bc, ca] as const];
      return parts.reduce((total, part) => total + sum(...part, halvings - 1), 0);
    };
    for (const latitude of [0, 0.5, -1.4, Math.PI / 2, -Math.PI / 2]) {
      for (const radius of [300, 3000, 9999]) {
        const centre: Place = [0.3, latitude];
        const ring = star(
          ...centre,
          [1, 0.7, 0.9, 1, 0.8].map((part) => part * radius),
        );
        const at = (i: number): Place => [ring[(2 * i) % ring.length], ring[(2 * i + 1) % ring.length]];
        const sums = [2, 3].map((halvings) =>
          [0, 1, 2, 3, 4].reduce((total, i) => total + sum(centre, at(i), at(i + 1), halvings), 0),
        );
        // Chords lack a share that a halving quarters (Richardson).
        const truth = sums[1] + (sums[1] - sums[0]) / 3;
        const tolerance = 2e-11 * truth + 1e-9 * 6 * radius;
        expect(Math.abs(geodesicPolygon(ring).area - truth)).toBeLessThanOrEqual(tolerance);
      }
      // Begun in the middle a ring is up to 40 km wide before it counts as large.
      const centre: Place = [0.3, latitude];
      const rim = star(...centre, new Array(6).fill(19_990));
      const at = (i: number): Place => [rim[2 * i], rim[2 * i + 1]];
      const sums = [2, 3].map((halvings) =>
        [0, 1, 2, 3, 4].reduce((total, i) => total + sum(centre, at(i), at(i + 1), halvings), 0),
      );
      const truth = sums[1] + (sums[1] - sums[0]) / 3;
      const { area } = geodesicPolygon([...centre, ...rim]);
      expect(Math.abs(area - truth)).toBeLessThanOrEqual(1e-10 * truth);
    }
  });

  it("between chords and between geodesics agree as far as the chords can", () => {
    fc.assert(
      fc.property(longitude, finite(-1.4, 1.4), finite(1e3, 1e5), (lon, lat, radius) => {
        const ring = star(lon, lat, new Array(24).fill(radius));
        const { area } = geodesicPolygon(ring);
        const chords = chordPolygon(ring);
        expect(Math.abs(chords.area - area)).toBeLessThanOrEqual(
          0.1 + (area * chords.extent ** 2) / (15 * WGS84.a ** 2),
        );
      }),
      { numRuns: 500 },
    );
  });

  it("of fewer than three vertices have no area", () => {
    expect(geodesicPolygon([]).area).toBe(0);
    expect(geodesicPolygon([1, 1]).area).toBe(0);
    expect(geodesicPolygon([1, 1, 1.1, 1]).area).toBeCloseTo(0, 9);
  });
});
