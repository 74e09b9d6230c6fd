import { ecefToGeodetic } from "../ellipsoid/ecef-to-geodetic.js";
import { ellipsoid, WGS84 } from "../ellipsoid/ellipsoid.js";
import { exactTransform } from "../engines/exact.js";
import type { ProjectionSampler } from "./patchwork.js";

export const BESSEL = ellipsoid(6377397.155, 1 / 299.1528128);
const METRE = { name: "metre", kind: "linear", size: 1 } as const;

/** Samples the inverse of a projection on its own ellipsoid (Bessel's or WGS 84's) by proj4js; counts its calls. */
export function samplerOf(proj4: string): ProjectionSampler & { calls: number } {
  const exact = exactTransform({
    proj4: `${proj4} +towgs84=0,0,0`,
    horizontalUnit: METRE,
    verticalUnit: { ...METRE, declared: true },
    height: { kind: "ellipsoidal" },
  });
  const shape = proj4.includes("+ellps=bessel") ? BESSEL : WGS84;
  const sampler = async (points: Float64Array) => {
    sampler.calls++;
    const places = new Float64Array(points.length);
    const ecef = new Float64Array(6);
    const geodetic = new Float64Array(3);
    for (let i = 0; i < points.length; i += 2) {
      exact(points[i], points[i + 1], ecef, 0);
      ecefToGeodetic(ecef[0], ecef[1], ecef[2], geodetic, 0, shape);
      places.set(geodetic.subarray(0, 2), i);
    }
    return places;
  };
  sampler.calls = 0;
  return sampler;
}
