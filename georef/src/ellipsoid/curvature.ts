import { type Ellipsoid, WGS84 } from "./ellipsoid.js";

/** How strongly an ellipsoid is curved at a latitude. */
export interface CurvatureRadii {
  /** Along the meridian, metres. */
  readonly meridian: number;
  /** Across it, along the prime vertical, metres. */
  readonly primeVertical: number;
}

/**
 * The two principal radii of curvature, a (1 − e²) / W³ and a / W with W² = 1 − e² sin² φ.
 * @param latitude radians
 */
export function curvatureRadii(latitude: number, { a, e2 }: Ellipsoid = WGS84): CurvatureRadii {
  const w2 = 1 - e2 * Math.sin(latitude) ** 2;
  const primeVertical = a / Math.sqrt(w2);
  return { meridian: (primeVertical * (1 - e2)) / w2, primeVertical };
}

/**
 * Radius of curvature of the normal section in a direction (Euler).
 * @param latitude radians
 * @param azimuth radians clockwise from north
 */
export function radiusAlong(latitude: number, azimuth: number, ellipsoid: Ellipsoid = WGS84): number {
  const { meridian, primeVertical } = curvatureRadii(latitude, ellipsoid);
  return 1 / (Math.cos(azimuth) ** 2 / meridian + Math.sin(azimuth) ** 2 / primeVertical);
}
