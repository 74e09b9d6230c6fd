import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { curvatureRadii, ellipsoid, geodesicBetween, radiusAlong, WGS84 } from "../index.js";

describe("radii of curvature", () => {
  it("are those of the poles and the equator", () => {
    const { a, f } = WGS84;
    const polar = a / (1 - f);
    expect(curvatureRadii(Math.PI / 2).meridian).toBeCloseTo(polar, 6);
    expect(curvatureRadii(Math.PI / 2).primeVertical).toBeCloseTo(polar, 6);
    expect(curvatureRadii(0).primeVertical).toBe(a);
    expect(curvatureRadii(0).meridian).toBeCloseTo(a * (1 - f) ** 2, 6);
    expect(radiusAlong(0.3, 1, ellipsoid(5, 0))).toBeCloseTo(5, 12);
  });

  it("turn angles into lengths along the meridian and across it", () => {
    const latitude = fc.double({ min: -1.5, max: 1.5, noNaN: true });
    fc.assert(
      fc.property(latitude, (at) => {
        const { meridian } = curvatureRadii(at);
        const step = 1e-5;
        const north = geodesicBetween(0, at - step / 2, 0, at + step / 2).distance;
        expect(north / step / meridian).toBeCloseTo(1, 8);
        expect(radiusAlong(at, 0)).toBeCloseTo(meridian, 6);
        expect(radiusAlong(at, Math.PI / 2)).toBeCloseTo(curvatureRadii(at).primeVertical, 6);
      }),
    );
  });
});
