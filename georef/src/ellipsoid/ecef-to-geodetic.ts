import { type Ellipsoid, WGS84 } from "./ellipsoid.js";

/**
 * Beyond this distance from the centre, in equatorial radii, the ellipsoid is a point and squares could overflow.
 * 2⁵² radii is where half the flattening vanishes in the last bit of the height.
 */
const FAR = 2 ** 52;
/** Coordinates below this (metres) count as zero: products of their squares would underflow. */
const NOTHING = 1e-60;

/**
 * Geocentric to geodetic coordinates in closed form, right everywhere: at the poles, on the axis, at the centre
 * and inside the evolute, where iterations and the textbook closed forms fail.
 *
 * Vermeille, "Direct transformation from geocentric coordinates to geodetic coordinates", J. Geodesy 76 (2002)
 * 451–454, arranged as Karney does (GeographicLib, Geocentric; "Geodesics on an ellipsoid of revolution",
 * arXiv:1102.1215, appendix B): no subtraction loses digits, the cubic has its trigonometric branch, and the disc
 * of the equatorial plane inside the evolute is a case of its own. Of several nearest points the northern is given,
 * and longitude 0 on the axis.
 *
 * @param x metres, as `y` and `z`
 * @param out receives longitude (radians, −π … π), latitude (radians), height (metres)
 * @param offset index in `out` of the longitude
 */
export function ecefToGeodetic(
  x: number,
  y: number,
  z: number,
  out: Float64Array,
  offset = 0,
  ellipsoid: Ellipsoid = WGS84,
): void {
  const { a, e2 } = ellipsoid;
  const e4 = e2 * e2;
  const oneMinusE2 = 1 - e2;
  const distance = Math.hypot(x, y);
  const fromAxis = distance < NOTHING ? 0 : distance;
  const fromEquator = Math.abs(z) < NOTHING ? 0 : z;
  out[offset] = fromAxis === 0 ? 0 : Math.atan2(y, x);

  const fromCentre = Math.hypot(fromAxis, fromEquator);
  if (fromCentre > FAR * a || e2 === 0) {
    out[offset + 1] = fromCentre === 0 ? Math.PI / 2 : Math.atan2(fromEquator, fromAxis);
    out[offset + 2] = fromCentre - a;
    return;
  }

  const p = (fromAxis / a) ** 2;
  const q = oneMinusE2 * (fromEquator / a) ** 2;
  const r = (p + q - e4) / 6;
  if (e4 * q === 0 && r <= 0) {
    // The disc z = 0 inside the evolute: the general form would divide zero by zero.
    const up = Math.sqrt((e4 - p) / oneMinusE2);
    const out1 = Math.sqrt(p);
    const length = Math.hypot(up, out1);
    out[offset + 1] = Math.atan2(z < 0 ? -up : up, out1);
    out[offset + 2] = (-a * oneMinusE2 * length) / e2;
    return;
  }

  const u = cubicRoot(r, (e4 * p * q) / 4);
  const v = Math.sqrt(u * u + e4 * q);
  const uv = u < 0 ? (e4 * q) / (v - u) : u + v;
  const w = Math.max(0, (e2 * (uv - q)) / (2 * v));
  const k = uv / (Math.sqrt(uv + w * w) + w);
  const d = (k * fromAxis) / (k + e2);
  out[offset + 1] = Math.atan2(fromEquator / k, fromAxis / (k + e2));
  out[offset + 2] = (1 - oneMinusE2 / k) * Math.hypot(d, fromEquator);
}

/** Vermeille's u: the largest root of u³ − 3ru² − 2S = 0, without cancellation on either side of its discriminant. */
function cubicRoot(r: number, S: number): number {
  const r3 = r * r * r;
  const discriminant = S * (2 * r3 + S);
  if (discriminant < 0) {
    const angle = Math.atan2(Math.sqrt(-discriminant), -(S + r3));
    return r + 2 * r * Math.cos(angle / 3);
  }
  const sum = S + r3;
  const t = Math.cbrt(sum + (sum < 0 ? -1 : 1) * Math.sqrt(discriminant));
  return t === 0 ? r : r + t + (r * r) / t;
}
