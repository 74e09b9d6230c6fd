import { geodeticToEcef } from "@groma/georef";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import type { NodeBounds } from "./octree-node.js";
import { distanceTo, horizonOf, outsideFrustum, pixelsPerMetre, type View } from "./view.js";

const RADIAN = Math.PI / 180;

function ecef(longitude: number, latitude: number, height: number): Float64Array {
  const out = new Float64Array(3);
  geodeticToEcef(longitude * RADIAN, latitude * RADIAN, height, out);
  return out;
}

function bounds(longitude: number, latitude: number, height: number, radius: number): NodeBounds {
  const [x, y, z] = ecef(longitude, latitude, height);
  return { x, y, z, radius, spacing: 1 };
}

function viewFrom(position: ArrayLike<number>, planes: number[] = [], horizon = true): View {
  return {
    position,
    direction: [1, 0, 0],
    planes,
    height: 1000,
    projection: { kind: "perspective", fieldOfView: Math.PI / 2 },
    horizon,
  };
}

describe("horizonOf", () => {
  const low = viewFrom(ecef(8, 47, 1000));

  it("hides the other side of the earth", () => {
    expect(horizonOf(low)(bounds(-172, -47, 0, 1000))).toBe(true);
    expect(horizonOf(low)(bounds(20, 47, 0, 1000))).toBe(true);
  });

  it("shows what is near, what towers over the horizon and what is too large to hide", () => {
    expect(horizonOf(low)(bounds(8.5, 47, 0, 100))).toBe(false);
    expect(horizonOf(low)(bounds(20, 47, 0, 100_000))).toBe(false);
    expect(horizonOf(low)(bounds(20, 47, 200_000, 1000))).toBe(false);
  });

  it("shows the floor of the deepest sea from the surface", () => {
    expect(horizonOf(viewFrom(ecef(142, 11, 100)))(bounds(142.2, 11.4, -11_000, 100))).toBe(false);
  });

  it("hides nothing from deep below the ellipsoid, nor where the globe hides nothing", () => {
    expect(horizonOf(viewFrom(ecef(8, 47, -13_000)))(bounds(-172, -47, 0, 1000))).toBe(false);
    expect(horizonOf(viewFrom(low.position, [], false))(bounds(-172, -47, 0, 1000))).toBe(false);
  });

  // Above the equator, where the occluder's section is a circle: the earth's, 12 km below WGS 84.
  const occluder = 6_378_137 - 12_000;
  const camera = 2 * occluder;

  it("hides a sphere until it reaches out of the cone of the lines that touch the earth", () => {
    const [longitude, distance] = [3, 6_378_137 + 100_000];
    const [x, y] = [distance * Math.cos(longitude), distance * Math.sin(longitude)];
    const slant = Math.hypot(camera - x, y);
    const toCone = slant * Math.sin(Math.asin(occluder / camera) - Math.asin(y / slant));
    const behind = horizonOf(viewFrom([camera, 0, 0]));
    const hidden = (radius: number) => behind({ x, y, z: 0, radius, spacing: 1 });
    expect(toCone).toBeGreaterThan(100_000);
    // The radius is taken 0.34 % too large, for the shorter axis, and never too small.
    expect([hidden(0.99 * toCone), hidden(1.001 * toCone)]).toEqual([true, false]);
    expect(behind({ x: -x, y, z: 0, radius: 0.99 * toCone, spacing: 1 })).toBe(false);
  });

  it("hides a sphere on the axis until it reaches through the plane of the horizon", () => {
    const plane = occluder ** 2 / camera;
    const behind = horizonOf(viewFrom([camera, 0, 0]));
    const hidden = (radius: number) => behind({ x: plane - 1_000_000, y: 0, z: 0, radius, spacing: 1 });
    expect([hidden(990_000), hidden(1_001_000)]).toEqual([true, false]);
  });

  it("hides as much from above a pole: the earth there is as wide as at the equator, and lower", () => {
    const [a, b] = [occluder, 6_356_752.314 - 12_000];
    const above = 2 * b;
    const behind = horizonOf(viewFrom([0, 0, above]));
    const [angle, distance] = [3, 6_400_000];
    // Across the axis in the units of the shorter one, in which the earth is a ball.
    const [z, across] = [distance * Math.cos(angle), distance * Math.sin(angle)];
    const slant = Math.hypot(above - z, across);
    const toCone = slant * Math.sin(Math.asin(b / above) - Math.asin(across / slant));
    for (const turn of [0, 1, 2, 3, 4, 5]) {
      const [x, y] = [Math.cos(turn), Math.sin(turn)].map((part) => (part * across * a) / b);
      const hidden = (radius: number) => behind({ x, y, z, radius, spacing: 1 });
      expect([hidden(0.999 * toCone), hidden(1.001 * toCone)]).toEqual([true, false]);
    }
  });

  it("hides no point in sight: the line to it stays above the ground", () => {
    const place = fc.record({
      longitude: fc.double({ min: -180, max: 180, noNaN: true }),
      latitude: fc.double({ min: -90, max: 90, noNaN: true }),
    });
    const height = fc.double({ min: 1, max: 2e7, noNaN: true });
    fc.assert(
      fc.property(place, height, place, (from, up, to) => {
        const camera = ecef(from.longitude, from.latitude, up);
        const target = bounds(to.longitude, to.latitude, 0, 1);
        if (!horizonOf(viewFrom(camera))(target)) return;
        // Somewhere on the line of sight, scaled to the unit sphere, the ground must be above it.
        const a = [camera[0] / 6378137, camera[1] / 6378137, camera[2] / 6356752.3];
        const b = [target.x / 6378137, target.y / 6378137, target.z / 6356752.3];
        const d = b.map((value, axis) => value - a[axis]);
        const t = -(a[0] * d[0] + a[1] * d[1] + a[2] * d[2]) / (d[0] ** 2 + d[1] ** 2 + d[2] ** 2);
        const nearest = Math.hypot(...a.map((value, axis) => value + Math.min(1, t) * d[axis]));
        expect(nearest).toBeLessThan(1);
      }),
      { numRuns: 2000 },
    );
  });
});

describe("outsideFrustum", () => {
  // Inside is x ≥ 100.
  const view = viewFrom([0, 0, 0], [1, 0, 0, -100]);

  it.each([
    [105, false],
    [95, false],
    [89, true],
  ])("a sphere of 10 m at x = %d is outside: %s", (x, outside) => {
    expect(outsideFrustum(view, { x, y: 0, z: 0, radius: 10, spacing: 1 })).toBe(outside);
  });
});

it("a sphere is outside of a frustum where it is outside of any of its planes, whichever way they look", () => {
  const direction = fc
    .tuple(...[0, 1, 2].map(() => fc.integer({ min: -9, max: 9 })))
    .filter((parts) => Math.hypot(...parts) > 0)
    .map((parts) => parts.map((part) => part / Math.hypot(...parts)));
  const plane = fc.record({ normal: direction, offset: fc.integer({ min: -50, max: 50 }) });
  const centres = fc.tuple(...[0, 1, 2].map(() => fc.integer({ min: -50, max: 50 })));
  fc.assert(
    fc.property(
      fc.array(plane, { maxLength: 6 }),
      centres,
      fc.integer({ min: 1, max: 30 }),
      (all, at, radius) => {
        const planes = all.flatMap(({ normal, offset }) => [...normal, offset]);
        const inner = all.map(({ normal, offset }) =>
          at.reduce((sum, part, i) => sum + part * normal[i], offset),
        );
        // Not what only touches a plane.
        fc.pre(inner.every((distance) => Math.abs(distance + radius) > 1e-9));
        const [x, y, z] = at;
        expect(outsideFrustum(viewFrom([0, 0, 0], planes), { x, y, z, radius, spacing: 1 })).toBe(
          inner.some((distance) => distance < -radius),
        );
      },
    ),
  );
});

describe("lengths on the screen", () => {
  const at = (x: number): NodeBounds => ({ x, y: 0, z: 0, radius: 10, spacing: 1 });

  it("are measured from the near side of a node's sphere", () => {
    expect(distanceTo(viewFrom([0, 0, 0]), at(110))).toBe(100);
    expect(distanceTo(viewFrom([0, 0, 0]), at(5))).toBe(0);
  });

  it("fill the picture at a metre's distance where the field of view is 90° and they are 2 m long", () => {
    const view = viewFrom([0, 0, 0]);
    expect(2 * pixelsPerMetre(view)).toBeCloseTo(view.height, 9);
    const narrow: View = { ...view, projection: { kind: "perspective", fieldOfView: Math.PI / 3 } };
    expect((2 / Math.sqrt(3)) * pixelsPerMetre(narrow)).toBeCloseTo(view.height, 9);
  });

  it("fill an orthographic picture at any distance where they are as long as its extent", () => {
    const view: View = { ...viewFrom([0, 0, 0]), projection: { kind: "orthographic", extent: 500 } };
    expect(500 * pixelsPerMetre(view)).toBe(view.height);
  });
});
