import { ecefToGeodetic } from "./ecef-to-geodetic.js";

/**
 * A local Cartesian frame, metres.
 * ECEF = origin + rotation · local; `rotation` is column-major, its columns the unit vectors east, north, up in ECEF.
 */
export interface Frame {
  /** ECEF, 3 values, metres. */
  readonly origin: Float64Array;
  /** 9 values, orthonormal and right-handed. */
  readonly rotation: Float64Array;
}

/**
 * East-north-up frame at a point of ECEF: up is the normal of WGS 84. At the poles, where east has no meaning,
 * it is that of the meridian 0.
 *
 * @param origin ECEF, 3 values, metres
 */
export function eastNorthUp(origin: ArrayLike<number>): Frame {
  const geodetic = new Float64Array(3);
  ecefToGeodetic(origin[0], origin[1], origin[2], geodetic);
  const [longitude, latitude] = geodetic;
  const sinLon = Math.sin(longitude);
  const cosLon = Math.cos(longitude);
  const sinLat = Math.sin(latitude);
  const cosLat = Math.cos(latitude);
  return {
    origin: Float64Array.of(origin[0], origin[1], origin[2]),
    rotation: Float64Array.of(
      ...[-sinLon, cosLon, 0],
      ...[-sinLat * cosLon, -sinLat * sinLon, cosLat],
      ...[cosLat * cosLon, cosLat * sinLon, sinLat],
    ),
  };
}
