import { ecefToGeodetic } from "../ellipsoid/ecef-to-geodetic.js";
import { WGS84 } from "../ellipsoid/ellipsoid.js";
import { compileTransformation, type StepwiseTruth } from "../transformation/evaluate.js";
import { type Link, premultiply } from "../transformation/link.js";
import { domainOf } from "../transformation/rectangle.js";
import type { Transformation } from "../transformation/step.js";
import type { ExactTransform } from "./exact.js";
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
export type PlaneTransform = (longitude: number, latitude: number, out: Float64Array, offset: number) => void;

/** The corners and the middle of a rectangle. */
export function corners(
  minX: number,
  minY: number,
  maxX: number,
  maxY: number,
): (readonly [number, number])[] {
  const middle = [(minX + maxX) / 2, (minY + maxY) / 2] as const;
  return [[minX, minY], [maxX, minY], [minX, maxY], [maxX, maxY], middle];
}

/** Metres above and below the middle where the way of a point is followed, as for a datum shift of kept height. */
const HALF_HEIGHT = 500;

/**
 * The map of a data set to the plane of a map, from that to ECEF and from longitude and latitude to the plane.
 *
 * @param middle middle height of the data set, source units
 * @param verticalUnit metres per source unit of z
 */
export function truthToPlane(
  truth: Truth,
  plane: MapPlane,
  toPlane: PlaneTransform,
  middle: number,
  verticalUnit: number,
  file: string,
): Truth {
  if (typeof truth === "function")
    return functionOnMap(truth, plane, toPlane, middle, HALF_HEIGHT / verticalUnit);
  const { transformation } = truth;
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
function functionOnMap(
  exact: ExactTransform,
  plane: MapPlane,
  toPlane: PlaneTransform,
  middle: number,
  half: number,
): ExactTransform {
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
