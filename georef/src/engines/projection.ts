import proj4 from "proj4";
import type { Crs } from "../crs/crs.js";
import { type Ellipsoid, ellipsoid, WGS84 } from "../ellipsoid/ellipsoid.js";
import { requireFields } from "../errors/arguments.js";
import { CrsError } from "../errors/errors.js";

/** The part of proj4js's projection object that is used here and that its own types do not tell. */
export interface Projection {
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
export const THREE_PARAMETERS = 1;
export const SEVEN_PARAMETERS = 2;
const GRIDS = 3;
const NULL_SHIFT = 4;
const NO_DATUM = 5;

/** Radians; beyond a pole by as much, 6 mm, stands what rounding puts there: the domain of a fit is widened by that. */
const POLE_MARGIN = 1e-9 * Math.PI;
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
 * Source x and y (source units) → longitude from Greenwich and latitude (radians) of the CRS's own datum, written at
 * `out[offset]` and after it; NaN where the CRS has no such place.
 */
export type PlaneInverse = (x: number, y: number, out: Float64Array, offset: number) => void;

/**
 * The inverse of a projection; for geographic CRSs that of the unit.
 * @param unit metres or radians per source unit
 */
export function inverseOf(projection: Projection, unit: number): PlaneInverse {
  const geographic = projection.projName === "longlat";
  const { x0: centre = 0, Qn } = projection;
  const meridian = projection.from_greenwich ?? 0;
  const reach = Qn === undefined ? Number.POSITIVE_INFINITY : SERIES_END * Qn * projection.a;
  return (x, y, out, offset) => {
    let longitude = x * unit;
    let latitude = y * unit;
    out[offset] = Number.NaN;
    out[offset + 1] = Number.NaN;
    if (Math.abs(longitude - centre) > reach) return;
    if (!geographic) {
      const point = invert(projection, longitude, latitude);
      longitude = point.x;
      latitude = point.y;
    }
    if (!(Math.abs(latitude) <= Math.PI / 2 + POLE_MARGIN && Math.abs(longitude) <= LONGITUDE_LIMIT)) return;
    out[offset] = longitude + meridian;
    out[offset + 1] = latitude;
  };
}

/** The plane of a projected CRS over its own ellipsoid: what a scale factor and a convergence are told by. */
export interface GridPlane {
  readonly ellipsoid: Ellipsoid;
  readonly toGeodetic: PlaneInverse;
}

/**
 * The plane of a CRS by its projection alone; no shift of datum has a part in it.
 * @returns undefined where source coordinates are no plane: longitude and latitude, geocentric ones
 * @throws CrsError CRS_UNSUPPORTED when the string needs grids or an unknown projection
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function gridPlane(crs: Pick<Crs, "proj4" | "horizontalUnit">): GridPlane | undefined {
  requireFields(crs, { proj4: "text", horizontalUnit: "object" }, "gridPlane: crs");
  if (crs.horizontalUnit.kind === "angular" || /\+proj=geocent\b/.test(crs.proj4)) return undefined;
  const projection = open(crs.proj4);
  if (projection.projName === "longlat") return undefined;
  // A sphere of no datum (Web Mercator) holds longitudes and latitudes of WGS 84; any other figure is the CRS's own.
  const figure = projection.es === 0 ? ellipsoidOf(projection) : ownEllipsoid(projection);
  return { ellipsoid: figure, toGeodetic: inverseOf(projection, crs.horizontalUnit.size) };
}

/** A projection of proj4js. @throws CrsError CRS_UNSUPPORTED where it does not know the text */
export function open(proj4String: string): Projection {
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
export function ellipsoidOf(projection: Projection): Ellipsoid {
  const { a, datum, datumCode } = projection;
  const own = ownEllipsoid(projection);
  const same = Math.abs(a - WGS84.a) < 1e-3 && Math.abs(own.f - WGS84.f) < 1e-9;
  const none = datumCode === "none" || datum.datum_type === NO_DATUM;
  return none || (same && datum.datum_type === NULL_SHIFT) ? WGS84 : own;
}

function ownEllipsoid({ a, es }: Projection): Ellipsoid {
  return ellipsoid(a, es / (1 + Math.sqrt(1 - es)));
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
