import { type Ellipsoid, WGS84 } from "./ellipsoid.js";

/**
 * Geodetic to geocentric coordinates (EPSG method 9602, forward).
 *
 * @param longitude radians
 * @param latitude radians
 * @param height metres above the ellipsoid, along its normal
 * @param out receives X, Y, Z in metres
 * @param offset index in `out` of X
 */
export function geodeticToEcef(
  longitude: number,
  latitude: number,
  height: number,
  out: Float64Array,
  offset = 0,
  ellipsoid: Ellipsoid = WGS84,
): void {
  const sinLatitude = Math.sin(latitude);
  const cosLatitude = Math.cos(latitude);
  const primeVertical = ellipsoid.a / Math.sqrt(1 - ellipsoid.e2 * sinLatitude * sinLatitude);
  const fromAxis = (primeVertical + height) * cosLatitude;
  out[offset] = fromAxis * Math.cos(longitude);
  out[offset + 1] = fromAxis * Math.sin(longitude);
  out[offset + 2] = (primeVertical * (1 - ellipsoid.e2) + height) * sinLatitude;
}
