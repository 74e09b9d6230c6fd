import { type Crs, type GridPlane, geodesicBetween, gridPlane, samePlane } from "@groma/georef";
import type { Vertex } from "./vertex.js";

/** The plane grid that two or more vertices have in common. */
export interface Grid {
  readonly name: string;
  /** Metres per unit of the grid. */
  readonly unit: number;
  readonly plane: GridPlane;
}

const planes = new WeakMap<Crs, GridPlane | null>();

/** Metres to each side of a point over which its scale factor and its convergence are told. */
const STEP = 50;

/**
 * The grid that vertices were recorded in; undefined where they have none in common: longitudes and latitudes, scans
 * placed without a CRS, places of no data set, two different projections.
 */
export function commonGrid(vertices: readonly Vertex[]): Grid | undefined {
  const crs = vertices[0]?.cloud?.crs;
  if (!crs || !vertices.every(({ cloud, source }) => cloud && source && sharesPlane(cloud.crs, crs))) {
    return undefined;
  }
  let plane = planes.get(crs);
  if (plane === undefined) {
    plane = gridPlane(crs) ?? null;
    planes.set(crs, plane);
  }
  return plane ? { name: crs.name, unit: crs.horizontalUnit.size, plane } : undefined;
}

function sharesPlane(a: Crs, b: Crs): boolean {
  return a === b || samePlane(a, b);
}

/** The geodesic below two grid points, on the grid's own ellipsoid. */
export function geodesicOfGrid({ plane }: Grid, a: ArrayLike<number>, b: ArrayLike<number>) {
  const ends = new Float64Array(4);
  plane.toGeodetic(a[0], a[1], ends, 0);
  plane.toGeodetic(b[0], b[1], ends, 2);
  return geodesicBetween(ends[0], ends[1], ends[2], ends[3], plane.ellipsoid);
}

/**
 * Scale factor of the projection in a direction of the grid: grid length over length on the ellipsoid.
 * @param bearing radians clockwise from grid north
 */
export function scaleFactorAt(grid: Grid, at: ArrayLike<number>, bearing: number): number {
  const step = STEP / grid.unit;
  const [x, y] = [step * Math.sin(bearing), step * Math.cos(bearing)];
  const { distance } = geodesicOfGrid(grid, [at[0] - x, at[1] - y], [at[0] + x, at[1] + y]);
  return (2 * STEP) / distance;
}

/** Meridian convergence: azimuth of grid north, radians clockwise from true north on the grid's own datum. */
export function convergenceAt(grid: Grid, at: ArrayLike<number>): number {
  const step = STEP / grid.unit;
  // The mean of both halves is the tangent at the point, but for their curvature's change.
  const ahead = geodesicOfGrid(grid, at, [at[0], at[1] + step]).azimuthFrom;
  const behind = geodesicOfGrid(grid, [at[0], at[1] - step], at).azimuthTo;
  return ahead + turn(behind - ahead) / 2;
}

/** An angle brought to −π … π. */
export function turn(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
