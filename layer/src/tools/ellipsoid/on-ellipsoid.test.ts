import { geodesicBetween, localPlane } from "@groma/georef";
import fc from "fast-check";
import { expect, it } from "vitest";
import { Corridor } from "../profile/corridor.js";
import { CrossSections } from "../sections/cross-sections.js";
import { CorridorOnEllipsoid, CrossSectionsOnEllipsoid } from "./on-ellipsoid.js";

const DEGREE = Math.PI / 180;

/** A scan in degrees about 7° E, 47° N; a strip 400 m long through its middle, and sections of it. */
const plane = localPlane(7 * DEGREE, 47 * DEGREE);
const degrees = (x: number, y: number, z: number, out: Float64Array) => out.set([x * DEGREE, y * DEGREE, z]);
const bounds = { min: [6.99, 46.99, 0], max: [7.01, 47.01, 100] } as const;
const line = new Corridor(
  [
    [-200, -50],
    [0, 30],
    [200, 0],
  ],
  20,
);
const strip = new CorridorOnEllipsoid(line, plane, degrees, bounds);
const sections = new CrossSectionsOnEllipsoid(
  new CrossSections(line, [50, 210], { left: 30, right: 30, thickness: 4 }),
  ...([plane, degrees, bounds] as const),
);
const longitude = fc.double({ min: 6.996, max: 7.004, noNaN: true });
const latitude = fc.double({ min: 46.9985, max: 47.0015, noNaN: true });

it("points are decided in metres on the ellipsoid, and boxes never say otherwise", () => {
  const place = new Float64Array(2);
  const out = new Uint32Array(2);
  let met = 0;
  fc.assert(
    fc.property(longitude, latitude, fc.double({ min: 1e-7, max: 4e-3, noNaN: true }), (x, y, size) => {
      plane.toPlane(x * DEGREE, y * DEGREE, place);
      const [east, north] = place;
      const inside = line.contains(east, north);
      expect(strip.contains(x, y, 5)).toBe(inside);
      const relation = strip.toBox(Float64Array.of(x - size, y - size, 0, x + size / 3, y + size, 9));
      if (inside) expect(relation).not.toBe("out");
      else expect(relation).not.toBe("in");
      if (inside) {
        met++;
        strip.locate(x, y, place);
        const alone = new Float64Array(2);
        line.locate(east, north, alone);
        expect([...place]).toEqual([...alone]);
      }
      const within = [0, 1].filter((part) => sections.sections[part].strip.contains(x, y, 5));
      expect([...out.subarray(0, sections.partsAt(x, y, 5, out))]).toEqual(within);
    }),
    { numRuns: 400 },
  );
  expect(met).toBeGreaterThan(0);
});

it("the plane has metres of the ellipsoid, and leads back", () => {
  const place = new Float64Array(2);
  for (const [x, y] of [
    [0.01, 0],
    [0, 0.01],
    [-0.02, 0.015],
  ]) {
    plane.toPlane((7 + x) * DEGREE, (47 + y) * DEGREE, place);
    const { distance } = geodesicBetween(7 * DEGREE, 47 * DEGREE, (7 + x) * DEGREE, (47 + y) * DEGREE);
    // The scale grows with the square of the distance from the meridian: 1.5 km give 3e-8.
    expect(Math.abs(Math.hypot(...place) / distance - 1)).toBeLessThan(5e-8);
  }
  plane.toPlane((7 + 1 / 3600) * DEGREE, 47 * DEGREE, place);
  plane.toGeodetic(place[0], place[1], place);
  expect(place[0]).toBeCloseTo((7 + 1 / 3600) * DEGREE, 13);
  plane.toPlane(Number.NaN, 1, place);
  expect([...place]).toEqual([Number.NaN, Number.NaN]);
});
