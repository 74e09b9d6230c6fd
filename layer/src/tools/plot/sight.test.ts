import fc from "fast-check";
import { describe, expect, it } from "vitest";
import type { TerrainStation } from "../terrain/terrain-line.js";
import { sightBetween, sightClearance, sightRise } from "./sight.js";

/** A place of a profile on a sphere: x along a tangent plane, y up, from chainage and height above the sphere. */
function onSphere([chainage, height]: readonly [number, number], radius: number): [number, number] {
  const angle = chainage / radius;
  return [(radius + height) * Math.sin(angle), (radius + height) * Math.cos(angle) - radius];
}

const station = (chainage: number, greatest: number, count = 9): TerrainStation => ({
  ...{ chainage, greatest, count, height: greatest, least: greatest, mean: greatest, deviation: 0 },
});

describe("sights along a profile", () => {
  it("are straight lines in space without refraction", () => {
    const place = fc.tuple(
      fc.double({ min: 0, max: 5000, noNaN: true }),
      fc.double({ min: -50, max: 50, noNaN: true }),
    );
    fc.assert(
      fc.property(place, place, fc.double({ min: 0, max: 1, noNaN: true }), (a, b, share) => {
        fc.pre(Math.abs(a[0] - b[0]) > 10);
        const radius = 6_371_008.8;
        const chainage = a[0] + share * (b[0] - a[0]);
        const [p, q] = [onSphere(a, radius), onSphere(b, radius)];
        const [x, y] = onSphere([chainage, sightBetween(a, b, { refraction: 0 })(chainage)], radius);
        // Distance from the chord; what is left is of third order, d³ / R².
        const across =
          ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) / Math.hypot(q[0] - p[0], q[1] - p[1]);
        expect(Math.abs(across)).toBeLessThan(2e-3);
      }),
    );
  });

  it("rise by 68 mm in a kilometre, of which refraction takes 10, and meet both ends", () => {
    expect(sightRise(1000)).toBeCloseTo(0.0683, 4);
    expect(sightRise(1000, { refraction: 0 }) - sightRise(1000)).toBeCloseTo(0.0102, 4);
    const sight = sightBetween([2000, 410], [500, 402]);
    expect(sight(2000)).toBe(410);
    expect(sight(500)).toBe(402);
    // In the middle a quarter of what a level sight of that length rises.
    expect(sight(1250)).toBeCloseTo(406 - sightRise(1500) / 4, 12);
  });

  it("tell where the ground comes nearest, over stations with points between both ends alone", () => {
    const ground = [
      station(0, 500),
      station(100, 401),
      station(150, 409, 0),
      station(200, 402.5),
      station(400, 500),
    ];
    const a = [0, 400] as const;
    const b = [400, 404] as const;
    const found = sightClearance(ground, a, b);
    expect(found?.chainage).toBe(200);
    expect(found?.clearance).toBeCloseTo(-0.5 - sightRise(400) / 4, 12);
    expect(sightClearance(ground, b, a)).toEqual(found);
    expect(sightClearance([], a, b)).toBeUndefined();
  });
});
