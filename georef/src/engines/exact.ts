import proj4 from "proj4";
import type { Crs } from "../crs/crs.js";
import { ecefToGeodetic } from "../ellipsoid/ecef-to-geodetic.js";
import { type Ellipsoid, ellipsoid, WGS84 } from "../ellipsoid/ellipsoid.js";
import { geodeticToEcef } from "../ellipsoid/geodetic-to-ecef.js";
import { CrsError } from "../errors/errors.js";

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

/** The part of proj4js's projection object that is used here and that its own types do not tell. */
interface Projection {
  readonly projName: string;
  readonly a: number;
  readonly es: number;
  readonly from_greenwich?: number;
  readonly datumCode?: string;
  /** False easting, metres. */
  readonly x0?: number;
  /** Of the transverse Mercator projection by series: radius of its rectifying sphere, scale included, over `a`. */
  readonly Qn?: number;
  over?: boolean;
  readonly datum: { readonly datum_type: number; readonly datum_params?: readonly number[] };
  forward(point: { x: number; y: number }): PlanePoint | null;
  inverse(point: { x: number; y: number }): PlanePoint | null;
}

/** `datum_type` of proj4js. */
const THREE_PARAMETERS = 1;
const SEVEN_PARAMETERS = 2;
const GRIDS = 3;
const NULL_SHIFT = 4;
const NO_DATUM = 5;

/** Longitudes more than two turns out are a mistake, not a place. */
const LONGITUDE_LIMIT = 4 * Math.PI;
/**
 * Where the transverse Mercator projection is left to itself: 50° of longitude from its meridian on the equator, as
 * easting over the radius. Its series of the sixth order is right to 0.1 µm up to there, off by 0.9 mm at 70° and by metres
 * beyond (Karney, "Transverse Mercator with an accuracy of a few nanometers", J. Geodesy 85 (2011) 475–485).
 */
const SERIES_END = Math.atanh(Math.sin((50 * Math.PI) / 180));
/** A forward projection that lands farther than this (metres) from where it started means: no inverse here. */
const LOST = 1;

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
 * the CRS says that its heights are ellipsoidal, and so above its own ellipsoid, does the shift move all three.
 *
 * Without a `+towgs84` the geodetic coordinates are taken as WGS 84, as PROJ does.
 *
 * @param middle height (source units) about which the shift's dependence on height is taken as linear; at a distance d
 *   from it that costs |shift| · (d / 6.4e6 m)², 16 µm for 600 m and 1 km
 * @throws CrsError CRS_UNSUPPORTED when the string needs grids or an unknown projection
 */
export function exactTransform(
  crs: Pick<Crs, "proj4" | "horizontalUnit" | "verticalUnit" | "height">,
  middle = 0,
): ExactTransform {
  const horizontal = crs.horizontalUnit.size;
  const vertical = crs.verticalUnit.size;
  if (/\+proj=geocent\b/.test(crs.proj4)) return geocentric(horizontal);

  const projection = open(crs.proj4);
  const shape = ellipsoidOf(projection);
  const meridian = projection.from_greenwich ?? 0;
  const shift = helmert(projection);
  const place =
    shift && crs.height.kind !== "ellipsoidal"
      ? keepingHeight(shape, shift, vertical, middle * vertical)
      : onEllipsoid(shape, shift, vertical);
  const geographic = projection.projName === "longlat";
  const { x0: centre = 0, Qn } = projection;
  const reach = Qn === undefined ? Number.POSITIVE_INFINITY : SERIES_END * Qn * projection.a;

  return (x, y, out, offset) => {
    let longitude = x * horizontal;
    let latitude = y * horizontal;
    if (Math.abs(longitude - centre) > reach) {
      out.fill(Number.NaN, offset, offset + 6);
      return;
    }
    if (!geographic) {
      const point = invert(projection, longitude, latitude);
      longitude = point.x;
      latitude = point.y;
    }
    if (!(Math.abs(latitude) <= Math.PI / 2 + 1e-12 && Math.abs(longitude) <= LONGITUDE_LIMIT)) {
      out.fill(Number.NaN, offset, offset + 6);
      return;
    }
    place(longitude + meridian, latitude, out, offset);
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

function open(proj4String: string): Projection {
  let projection: Projection;
  try {
    projection = new proj4.Proj(proj4String) as unknown as Projection;
  } catch (error) {
    throw unsupported(
      proj4String,
      `proj4js cannot read it (${error instanceof Error ? error.message : error})`,
    );
  }
  if (projection.datum.datum_type === GRIDS) throw unsupported(proj4String, "it needs datum shift grids");
  // Longitudes beyond 180° belong to data that cross the antimeridian; sine and cosine do the wrapping.
  projection.over = true;
  return projection;
}

function unsupported(proj4String: string, cause: string): CrsError {
  return new CrsError({
    code: "CRS_UNSUPPORTED",
    file: proj4String,
    cause,
    fix: "give a PROJ string with a projection that proj4js knows and a +towgs84 shift",
  });
}

/**
 * The ellipsoid that the geodetic coordinates are turned into ECEF on. It is that of the projection where a shift
 * follows. Where none does (no datum, a null shift, Web Mercator's sphere with `+nadgrids=@null`) the coordinates count as
 * those of WGS 84, as PROJ has it; GRS 80 differs by 0.1 mm.
 */
function ellipsoidOf({ a, es, datum, datumCode }: Projection): Ellipsoid {
  const own = ellipsoid(a, es / (1 + Math.sqrt(1 - es)));
  const same = Math.abs(a - WGS84.a) < 1e-3 && Math.abs(own.f - WGS84.f) < 1e-9;
  const none = datumCode === "none" || datum.datum_type === NO_DATUM;
  return none || (same && datum.datum_type === NULL_SHIFT) ? WGS84 : own;
}

function invert(projection: Projection, x: number, y: number): PlanePoint {
  const first = attempt(() => projection.inverse({ x, y }));
  const back = attempt(() => projection.forward({ x: first.x, y: first.y }));
  const dx = x - back.x;
  const dy = y - back.y;
  if (!(Math.abs(dx) < LOST && Math.abs(dy) < LOST)) return NOWHERE;
  if (dx === 0 && dy === 0) return first;
  const second = attempt(() => projection.inverse({ x: x + dx, y: y + dy }));
  return Number.isFinite(second.x) && Number.isFinite(second.y) ? second : first;
}

interface PlanePoint {
  readonly x: number;
  readonly y: number;
}

const NOWHERE: PlanePoint = { x: Number.NaN, y: Number.NaN };

/** Where a projection has no place for a point, proj4js returns null or NaN, or throws. */
function attempt(project: () => PlanePoint | null | undefined): PlanePoint {
  try {
    return project() ?? NOWHERE;
  } catch {
    return NOWHERE;
  }
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
