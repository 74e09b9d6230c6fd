import proj4 from "proj4";
import type { Crs } from "../crs/crs.js";
import { ecefToGeodetic } from "../ellipsoid/ecef-to-geodetic.js";
import { WGS84 } from "../ellipsoid/ellipsoid.js";
import { requireFields } from "../errors/arguments.js";
import { CrsError } from "../errors/errors.js";
import { compileTransformation, type StepwiseTruth } from "../transformation/evaluate.js";
import { type Link, premultiply } from "../transformation/link.js";
import { domainOf, type Rectangle } from "../transformation/rectangle.js";
import type { Transformation } from "../transformation/step.js";
import type { ExactTransform } from "./exact.js";
import { inverseOf, open, type Projection, SEVEN_PARAMETERS, THREE_PARAMETERS } from "./projection.js";
import type { Truth } from "./truth.js";

/**
 * The plane of a map as a place for points: x and y are coordinates of its projection times {@link metresPerUnit}, z is
 * the height above WGS 84 in metres. Plain data, crosses to workers.
 */
export interface MapPlane {
  /** Name of the projection, such as `EPSG:3857`. */
  readonly code: string;
  /** What proj4js makes the projection of: a PROJ string, or a definition as `proj4.defs` gives it. */
  readonly definition: string | object;
  /** Nominal metres per unit of the projection. */
  readonly metresPerUnit: number;
  /** Whether the map goes on beyond 180° to east and west, as one world after another. */
  readonly wraps: boolean;
  /** Longitude of the middle of the data set, radians: all others are taken on the turn nearest to it. */
  readonly middle: number;
  /** Whether it is the data set's own plane: x and y are then those of the source, whatever lies between its datum and WGS 84. */
  readonly own: boolean;
}

/** Longitude, latitude (radians, WGS 84) → x, y (nominal metres) at `out[offset]` …, NaN where there is no such place. */
type PlaneTransform = (longitude: number, latitude: number, out: Float64Array, offset: number) => void;

const TURN = 2 * Math.PI;
const DEGREE = Math.PI / 180;

/**
 * The way that OpenLayers itself takes to a projection registered with proj4js: from WGS 84, with the datum shift of the
 * definition at height 0, so that points lie where the map's other layers have the same longitude and latitude.
 *
 * @throws CrsError CRS_UNSUPPORTED where proj4js does not know the projection
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function planeTransform(map: MapPlane): PlaneTransform {
  requireFields(map, { code: "text", metresPerUnit: "number", middle: "number" }, "planeTransform: map");
  const { code, definition, metresPerUnit, wraps, middle } = map;
  const world = new proj4.Proj("WGS84");
  const plane = openPlane(code, definition);
  // Longitudes beyond 180° go on beyond the edge of the world.
  if (wraps) plane.over = true;
  const from = { x: 0, y: 0 };
  return (longitude, latitude, out, offset) => {
    out[offset] = Number.NaN;
    out[offset + 1] = Number.NaN;
    if (!Number.isFinite(longitude) || !Number.isFinite(latitude)) return;
    from.x = (longitude - TURN * Math.round((longitude - middle) / TURN)) / DEGREE;
    from.y = latitude / DEGREE;
    try {
      const there = proj4.transform(world, plane as unknown as typeof world, from, false);
      if (!there) return;
      out[offset] = there.x * metresPerUnit;
      out[offset + 1] = there.y * metresPerUnit;
    } catch {
      // proj4js throws where a projection has no such place.
    }
  };
}

function openPlane(code: string, definition: string | object): Projection {
  try {
    // proj4js writes into what it is given.
    const own = typeof definition === "string" ? definition : { ...definition };
    return new proj4.Proj(own as string) as unknown as Projection;
  } catch (thrown) {
    throw new CrsError({
      code: "CRS_UNSUPPORTED",
      file: code,
      cause: `proj4js cannot read the projection (${thrown instanceof Error ? thrown.message : thrown})`,
      fix: "register the projection with proj4.defs, or show the map in another one",
    });
  }
}

/** Metres within which two projections are one: false eastings in feet are written as rounded metres. */
const SAME_PLACE = 1e-5;
/** Relative difference of units and shifts, and difference of squared eccentricities: GRS 80 and WGS 84 differ by 3e-11. */
const SAME_NUMBER = 1e-9;
const SAME_SHAPE = 1e-12;

/**
 * Whether the plane of a map is the data set's own, however the two are written: both projections are of one ellipsoid
 * and lead to the same coordinates at the corners and the middle of a rectangle, in the same unit, and nothing says that
 * their datums differ. Two shifts to WGS 84 that differ do say so, unless the codes are equal; one text that names a
 * shift and one that names none do not.
 *
 * @param rectangle of the data set, source units
 */
export function isOwnPlane(
  crs: Pick<Crs, "proj4" | "horizontalUnit" | "code">,
  { code, definition }: Pick<MapPlane, "code" | "definition">,
  { minX, minY, maxX, maxY }: Rectangle,
): boolean {
  if (/\+proj=geocent\b/.test(crs.proj4)) return false;
  const source = open(crs.proj4);
  const plane: Projection & { readonly to_meter?: number } = openPlane(code, definition);
  const angular = plane.projName === "longlat";
  const unit = angular ? DEGREE : (plane.to_meter ?? 1);
  const { size } = crs.horizontalUnit;
  if (angular !== (source.projName === "longlat") || Math.abs(size / unit - 1) > SAME_NUMBER) return false;
  if (Math.abs(source.a - plane.a) > SAME_PLACE || Math.abs(source.es - plane.es) > SAME_SHAPE) return false;
  if (crs.code?.split("+")[0] !== code && haveOtherShifts(source, plane)) return false;
  const meridian = plane.from_greenwich ?? 0;
  if (angular) return meridian === (source.from_greenwich ?? 0);
  const inverse = inverseOf(source, size);
  const place = new Float64Array(2);
  return corners(minX, minY, maxX, maxY).every(([x, y]) => {
    inverse(x, y, place, 0);
    const back = plane.forward({ x: place[0] - meridian, y: place[1] });
    return back && Math.hypot(back.x - x * size, back.y - y * size) <= SAME_PLACE;
  });
}

/** Whether two projections both name a shift to WGS 84, and not the same one. */
function haveOtherShifts(one: Projection, other: Projection): boolean {
  const [a, b] = [one, other].map(({ datum: { datum_type: type, datum_params: numbers = [] } }) => {
    const named = type === THREE_PARAMETERS || type === SEVEN_PARAMETERS;
    // A shift of three numbers has no rotations and no scale.
    return NO_SHIFT.map((nothing, at) => Number((named ? numbers[at] : undefined) ?? nothing));
  });
  const differ = (x: readonly number[], y: readonly number[]) =>
    x.some((value, at) => Math.abs(value - y[at]) > SAME_NUMBER * Math.max(1, Math.abs(value)));
  return differ(a, NO_SHIFT) && differ(b, NO_SHIFT) && differ(a, b);
}

/** Translations, rotations and scale as proj4js has them. */
const NO_SHIFT = [0, 0, 0, 0, 0, 0, 1];

function corners(minX: number, minY: number, maxX: number, maxY: number): (readonly [number, number])[] {
  const middle = [(minX + maxX) / 2, (minY + maxY) / 2] as const;
  return [[minX, minY], [maxX, minY], [minX, maxY], [maxX, maxY], middle];
}

/** Metres above and below the middle where the way of a point is followed, as for a datum shift of kept height. */
const HALF_HEIGHT = 500;

/**
 * The map of a data set to the plane of a map, from that to ECEF.
 *
 * @param middle middle height of the data set, source units
 * @param verticalUnit metres per source unit of z
 * @throws CrsError CRS_UNSUPPORTED where proj4js does not know the projection
 */
export function truthOnMap(
  truth: Truth,
  plane: MapPlane,
  middle: number,
  verticalUnit: number,
  file: string,
): Truth {
  if (typeof truth === "function") return functionOnMap(truth, plane, middle, HALF_HEIGHT / verticalUnit);
  const { transformation } = truth;
  const toPlane = planeTransform(plane);
  const compiled = compileTransformation(transformation, file, mapLink(toPlane));
  const onMap = { ...compiled, stretch: stretchOf(transformation, file, toPlane) };
  if (!plane.own) return onMap;
  const own = plane.metresPerUnit;
  const owned: StepwiseTruth = {
    ...{ transformation, end: compiled.end, stretch: onMap.stretch, own },
    evaluate(x, y, z, out, offset) {
      compiled.evaluate(x, y, z, out, offset);
      out[offset] = x * own;
      out[offset + 1] = y * own;
    },
  };
  return owned;
}

/** Nominal metres per metre on the ground, the greatest of the corners and the middle of a data set. */
function stretchOf(transformation: Transformation, file: string, toPlane: PlaneTransform): number {
  const { minX, minY, maxX, maxY } = domainOf(transformation);
  const { evaluate } = compileTransformation(transformation, file, STAY);
  const jacobian = new Float64Array(9);
  const place = new Float64Array(3);
  const link = mapLink(toPlane);
  const found = corners(minX, minY, maxX, maxY).map(([x, y]) => {
    evaluate(x, y, 0, place, 0);
    const cosine = Math.cos(place[1]);
    jacobian.set([1 / (WGS84.a * cosine), 0, 0, 0, 1 / POLAR_RADIUS, 0, 0, 0, 1]);
    link.differentiate(place, jacobian);
    return Math.hypot(jacobian[0], jacobian[1], jacobian[3], jacobian[4]);
  });
  return Math.max(1, ...found.filter(Number.isFinite));
}

/** Least radius of curvature of WGS 84, metres. */
const POLAR_RADIUS = WGS84.a * (1 - WGS84.e2);

/** Leaves geodetic coordinates as they are. */
const STAY: Link = { apply: () => undefined, differentiate: () => undefined };

/** P and n from two heights. */
function functionOnMap(exact: ExactTransform, plane: MapPlane, middle: number, half: number): ExactTransform {
  const toPlane = planeTransform(plane);
  const parts = new Float64Array(6);
  const [low, high] = [new Float64Array(3), new Float64Array(3)];
  const follow = (z: number, out: Float64Array) => {
    const [x, y, up] = [0, 1, 2].map((axis) => parts[axis] + z * parts[axis + 3]);
    ecefToGeodetic(x, y, up, out);
    toPlane(out[0], out[1], out, 0);
  };
  return (x, y, out, offset) => {
    exact(x, y, parts, 0);
    follow(middle - half, low);
    follow(middle + half, high);
    for (let axis = 0; axis < 3; axis++) {
      const slope = (high[axis] - low[axis]) / (2 * half);
      out[offset + axis] = (low[axis] + high[axis]) / 2 - middle * slope;
      out[offset + axis + 3] = slope;
    }
    if (!plane.own || Number.isNaN(out[offset + 2])) return;
    out[offset] = x * plane.metresPerUnit;
    out[offset + 1] = y * plane.metresPerUnit;
    out[offset + 3] = 0;
    out[offset + 4] = 0;
  };
}

/** Radians by which a derivative is taken: some 60 m, where rounding and curvature both cost less than 1e-8 of it. */
const STEP = 1e-5;

/** Geodetic coordinates to the plane; heights stay. */
function mapLink(toPlane: PlaneTransform): Link {
  const own = new Float64Array(9);
  const [ahead, behind] = [new Float64Array(2), new Float64Array(2)];
  const column = (state: Float64Array, axis: 0 | 1) => {
    const [east, north] = axis === 0 ? [STEP, 0] : [0, STEP];
    toPlane(state[0] + east, state[1] + north, ahead, 0);
    toPlane(state[0] - east, state[1] - north, behind, 0);
    own[axis] = (ahead[0] - behind[0]) / (2 * STEP);
    own[3 + axis] = (ahead[1] - behind[1]) / (2 * STEP);
  };
  return {
    apply: (state) => toPlane(state[0], state[1], state, 0),
    differentiate(state, jacobian) {
      column(state, 0);
      column(state, 1);
      own[8] = 1;
      premultiply(own, jacobian);
      toPlane(state[0], state[1], state, 0);
    },
  };
}
