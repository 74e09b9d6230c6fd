import { ecefToGeodetic } from "./ecef-to-geodetic.js";

/**
 * A local Cartesian frame, metres.
 * ECEF = origin + rotation · local; `rotation` is column-major, its columns the unit vectors east, north, up in ECEF.
 * On a map the plane of its projection and the height stand in the place of ECEF.
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

/** A direction of ECEF in a frame. */
export function turnIn(
  { rotation: r }: Frame,
  x: number,
  y: number,
  z: number,
): readonly [number, number, number] {
  return [r[0] * x + r[1] * y + r[2] * z, r[3] * x + r[4] * y + r[5] * z, r[6] * x + r[7] * y + r[8] * z];
}

/** A point of ECEF in a frame; the difference to its origin is formed first. */
export function pointIn(frame: Frame, x: number, y: number, z: number): readonly [number, number, number] {
  const { origin } = frame;
  return turnIn(frame, x - origin[0], y - origin[1], z - origin[2]);
}

/** A point of a frame in ECEF. */
export function pointOf(
  { rotation: r, origin }: Frame,
  x: number,
  y: number,
  z: number,
): readonly [number, number, number] {
  return [
    origin[0] + r[0] * x + r[3] * y + r[6] * z,
    origin[1] + r[1] * x + r[4] * y + r[7] * z,
    origin[2] + r[2] * x + r[5] * y + r[8] * z,
  ];
}

/** A direction of a frame in ECEF. */
export function turnOut(
  { rotation: r }: Frame,
  x: number,
  y: number,
  z: number,
): readonly [number, number, number] {
  return [r[0] * x + r[3] * y + r[6] * z, r[1] * x + r[4] * y + r[7] * z, r[2] * x + r[5] * y + r[8] * z];
}

/** Frame at a point of a map: its axes are those of the map and the height. @param origin x, y, height, metres */
export function levelFrame(origin: ArrayLike<number>): Frame {
  return {
    origin: Float64Array.of(origin[0], origin[1], origin[2]),
    rotation: Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1),
  };
}
