import proj4 from "proj4";
import type { Crs } from "../crs/crs.js";
import { isAboveOwnEllipsoid } from "../crs/same.js";
import { ecefToGeodetic } from "../ellipsoid/ecef-to-geodetic.js";
import type { Ellipsoid } from "../ellipsoid/ellipsoid.js";
import { geodeticToEcef } from "../ellipsoid/geodetic-to-ecef.js";
import { requireFields } from "../errors/arguments.js";
import {
  ellipsoidOf,
  inverseOf,
  open,
  type Projection,
  SEVEN_PARAMETERS,
  THREE_PARAMETERS,
} from "./projection.js";

/**
 * The map source CRS → ECEF, exactly linear in z for a fixed (x, y), Helmert shifts included:
 * ECEF = P(x, y) + z · n(x, y), with x, y, z in source units and ECEF (EPSG:4978) in metres.
 * Writes P at `out[offset]` … and n (metres of ECEF per source unit of z) at `out[offset + 3]` …; all NaN where
 * the CRS has no such place.
 */
export type ExactTransform = (x: number, y: number, out: Float64Array, offset: number) => void;

/**
 * What computes the exact transform, for the georeference record. Bundlers take proj4js from its sources, which have a
 * placeholder for the version: there it is only known to be one that this package accepts (peerDependencies).
 */
export const ENGINE = {
  name: "proj4js",
  version: /^\d/.test(proj4.version) ? proj4.version : "2.22+",
} as const;

/**
 * The truth as proj4js gives it: its inverse projection, then the ellipsoid and the Helmert shift of
 * `crs.proj4` in this package's own arithmetic. proj4js's transformation between CRSs is not used (it ignores vertical
 * units and iterates through geodetic coordinates).
 *
 * An inverse projection is improved by one step with its own forward projection, because some stop early
 * (`somerc` at 1e-7 rad, 0.16 mm); where the forward projection does not lead back, the result is NaN.
 *
 * A horizontal datum shift must not touch a height that is not measured from the shifted ellipsoid, so as PROJ does
 * (push and pop of v_3) the shift moves longitude and latitude only, and z is taken as height above WGS 84. Only where
 * the CRS has three dimensions, and so heights above its own ellipsoid, does the shift move all three.
 *
 * Without a `+towgs84` the geodetic coordinates are taken as WGS 84, as PROJ does.
 *
 * @param middle height (source units) about which the shift's dependence on height is taken as linear; at a distance d
 *   from it that costs |shift| · (d / 6.4e6 m)², 16 µm for 600 m and 1 km
 * @throws CrsError CRS_UNSUPPORTED when the string needs grids or an unknown projection
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function exactTransform(
  crs: Pick<Crs, "proj4" | "horizontalUnit" | "verticalUnit" | "height">,
  middle = 0,
): ExactTransform {
  requireFields(
    crs,
    { proj4: "text", horizontalUnit: "object", verticalUnit: "object", height: "object" },
    "exactTransform: crs",
  );
  const horizontal = crs.horizontalUnit.size;
  const vertical = crs.verticalUnit.size;
  if (/\+proj=geocent\b/.test(crs.proj4)) return geocentric(horizontal);

  const projection = open(crs.proj4);
  const shape = ellipsoidOf(projection);
  const shift = helmert(projection);
  const place =
    shift && !isAboveOwnEllipsoid(crs)
      ? keepingHeight(shape, shift, vertical, middle * vertical)
      : onEllipsoid(shape, shift, vertical);
  const inverse = inverseOf(projection, horizontal);
  const geodetic = new Float64Array(2);

  return (x, y, out, offset) => {
    inverse(x, y, geodetic, 0);
    if (Number.isNaN(geodetic[0])) out.fill(Number.NaN, offset, offset + 6);
    else place(geodetic[0], geodetic[1], out, offset);
  };
}

/** Longitude and latitude (radians) of the CRS's own datum → P and n. */
type Placer = (longitude: number, latitude: number, out: Float64Array, offset: number) => void;

/** Heights above the ellipsoid that longitude and latitude belong to; the shift, if any, moves all three. */
function onEllipsoid(shape: Ellipsoid, shift: Helmert | undefined, vertical: number): Placer {
  return (longitude, latitude, out, offset) => {
    const sinLatitude = Math.sin(latitude);
    const cosLatitude = Math.cos(latitude);
    const primeVertical = shape.a / Math.sqrt(1 - shape.e2 * sinLatitude * sinLatitude);
    const nx = cosLatitude * Math.cos(longitude);
    const ny = cosLatitude * Math.sin(longitude);
    out[offset] = primeVertical * nx;
    out[offset + 1] = primeVertical * ny;
    out[offset + 2] = primeVertical * (1 - shape.e2) * sinLatitude;
    out[offset + 3] = nx * vertical;
    out[offset + 4] = ny * vertical;
    out[offset + 5] = sinLatitude * vertical;
    shift?.(out, offset);
  };
}

/** Metres above and below the middle where the way of a point is followed. */
const HALF_HEIGHT = 500;

/**
 * Geodetic → ECEF → shift → geodetic of WGS 84, whose height is replaced by the one that came in. P and n follow from
 * two heights.
 */
function keepingHeight(shape: Ellipsoid, shift: Helmert, vertical: number, middle: number): Placer {
  const low = new Float64Array(6);
  const high = new Float64Array(6);
  const geodetic = new Float64Array(3);
  const follow = (longitude: number, latitude: number, height: number, state: Float64Array) => {
    geodeticToEcef(longitude, latitude, height, state, 0, shape);
    shift(state, 0);
    ecefToGeodetic(state[0], state[1], state[2], geodetic);
    geodeticToEcef(geodetic[0], geodetic[1], height, state, 0);
  };
  return (longitude, latitude, out, offset) => {
    follow(longitude, latitude, middle - HALF_HEIGHT, low);
    follow(longitude, latitude, middle + HALF_HEIGHT, high);
    for (let axis = 0; axis < 3; axis++) {
      const slope = (high[axis] - low[axis]) / (2 * HALF_HEIGHT);
      out[offset + axis] = (low[axis] + high[axis]) / 2 - middle * slope;
      out[offset + axis + 3] = slope * vertical;
    }
  };
}

/** EPSG:4978 and its like: x and y are X and Y, z runs along Z. */
function geocentric(unit: number): ExactTransform {
  return (x, y, out, offset) => {
    out.fill(0, offset, offset + 6);
    out[offset] = x * unit;
    out[offset + 1] = y * unit;
    out[offset + 5] = unit;
  };
}

/** Shifts P and n, six numbers, in place. */
type Helmert = (out: Float64Array, offset: number) => void;

/**
 * Helmert shift in place on P and n (EPSG methods 1031 and 1033, position vector convention; linearised rotation,
 * as PROJ's `+towgs84`). Translations act on P only: n is a direction.
 */
function helmert(projection: Projection): Helmert | undefined {
  const { datum_type: type, datum_params: parameters = [] } = projection.datum;
  const [tx = 0, ty = 0, tz = 0] = parameters;
  if (type === THREE_PARAMETERS) {
    return (out, offset) => {
      out[offset] += tx;
      out[offset + 1] += ty;
      out[offset + 2] += tz;
    };
  }
  if (type !== SEVEN_PARAMETERS) return undefined;
  // proj4js has turned the rotations to radians and the scale to a factor.
  const [, , , rx = 0, ry = 0, rz = 0, scale = 1] = parameters;
  return (out, offset) => {
    for (let i = offset; i <= offset + 3; i += 3) {
      const x = out[i];
      const y = out[i + 1];
      const z = out[i + 2];
      const translate = i === offset ? 1 : 0;
      out[i] = scale * (x - rz * y + ry * z) + translate * tx;
      out[i + 1] = scale * (rz * x + y - rx * z) + translate * ty;
      out[i + 2] = scale * (-ry * x + rx * y + z) + translate * tz;
    }
  };
}
