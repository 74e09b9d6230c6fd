import { sameHeights } from "@groma/georef";
import { axesAt } from "../vertex/axes.js";
import { commonGrid, type Grid, geodesicOfGrid, scaleFactorAt } from "../vertex/grid.js";
import type { Vertex } from "../vertex/vertex.js";
import { acrossError, type Term } from "../worth/near-noise.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, type QuantityOptions, quantity } from "../worth/quantity.js";
import { type Line, levelTerm, lineOf, raised, spaceTerm, verticalSensitivity } from "./line.js";

/** A length in the plane of a projection, and what leads from it to the ground. */
export interface GridDistance {
  /** Name of the coordinate system. */
  readonly name: string;
  readonly distance: Quantity<"m">;
  /** Grid length over length on the grid's own ellipsoid. */
  readonly scaleFactor: number;
  /** Length on that ellipsoid over level length at the mean height of the ends. */
  readonly elevationFactor: number;
  /** Grid length over level length: their product. */
  readonly combinedFactor: number;
}

/** How far it is from one vertex to another. */
export interface Distance {
  /** Straight through space. */
  readonly space: Quantity<"m">;
  /** The shortest line on the ellipsoid of WGS 84, below both points. */
  readonly geodesic: Quantity<"m">;
  /** Level, at the mean height of both points: the geodesic, raised. */
  readonly horizontal: Quantity<"m">;
  /** Height of the second point less that of the first. */
  readonly vertical: Quantity<"m">;
  /** What `vertical` is measured along: "ellipsoid WGS 84", or the height system that both points were recorded in. */
  readonly heights: string;
  /** Undefined where the points have no grid in common. */
  readonly grid?: GridDistance | undefined;
}

/**
 * Every distance of two points. Coincident, antipodal and polar points included; the geodesic is right to 15 nm
 * (Karney 2013).
 */
export function measureDistance(a: Vertex, b: Vertex, options: WorthOptions = {}): Distance {
  const line = lineOf(a, b);
  const horizontal = line.geodesic.distance * raised(line);
  const grid = commonGrid([a, b]);
  return {
    space: lengthOf(line.space, spaceTerm(line, options), options),
    geodesic: lengthOf(line.geodesic.distance, levelTerm(line, options), options),
    horizontal: lengthOf(horizontal, levelTerm(line, options, raised(line)), options),
    ...heightDifference(line, options),
    ...(grid && { grid: gridDistance(grid, line, options) }),
  };
}

/** A length with its worth. */
export function lengthOf(
  value: number,
  { sensitivities, across }: Term,
  options: QuantityOptions,
): Quantity<"m"> {
  return quantity(value, "m", sensitivities, { ...options, own: acrossError(across) });
}

/** Height of the end less that of the start, in the system that both were recorded in where they share one. */
export function heightDifference(
  line: Line,
  options: WorthOptions,
): { readonly vertical: Quantity<"m">; readonly heights: string } {
  const { a, b } = line;
  const heights = commonHeights(a, b);
  const ofRecords: QuantityOptions = { ...options, ofRecords: true };
  const difference = heights
    ? (b.source![2] - a.source![2]) * a.cloud!.crs.verticalUnit.size
    : b.height - a.height;
  return {
    vertical: quantity(difference, "m", verticalSensitivity(line), heights ? ofRecords : options),
    heights: heights ?? "ellipsoid WGS 84",
  };
}

/** Name of the height system that two vertices were recorded in; undefined where they share none. */
export function commonHeights(a: Vertex, b: Vertex): string | undefined {
  const [one, other] = [a.cloud, b.cloud];
  if (!one || !other || !a.source || !b.source) return undefined;
  const { crs } = one;
  // Along Z of geocentric coordinates nothing is up, and z of a scan placed as a body may lean.
  if (/\+proj=geocent\b/.test(crs.proj4)) return undefined;
  // Two scans of unknown heights need not have the same.
  if (one !== other && (crs.height.kind === "unknown" || !sameHeights(crs, other.crs))) return undefined;
  if (crs.height.kind === "geoid") return crs.height.model;
  return crs.height.kind === "unknown" ? `${one.name}: unknown` : `ellipsoid of ${crs.name}`;
}

function gridDistance(grid: Grid, line: Line, options: WorthOptions): GridDistance {
  const [a, b] = [line.a.source!, line.b.source!];
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = Math.hypot(dx, dy) * grid.unit;
  const scaleFactor = gridFactor(grid, line);
  const elevationFactor = 1 / raised(line);
  const ofRecords: QuantityOptions = { ...options, ofRecords: true };
  return {
    name: grid.name,
    distance: lengthOf(length, levelTerm(line, ofRecords, scaleFactor), ofRecords),
    scaleFactor,
    elevationFactor,
    combinedFactor: scaleFactor * elevationFactor,
  };
}

/** Grid length over length on the grid's own ellipsoid. */
export function gridFactor(grid: Grid, line: Line): number {
  const [a, b] = [line.a.source!, line.b.source!];
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = Math.hypot(dx, dy) * grid.unit;
  if (length >= SHORT) return length / geodesicOfGrid(grid, a, b).distance;
  return scaleFactorAt(grid, [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], Math.atan2(dx, dy));
}

/** Metres below which the factor of the middle is the finer one: 15 nm of a geodesic are 1.5e-9 of ten metres. */
const SHORT = 10;

/** Height of a vertex above the ellipsoid. */
export function measureHeight(vertex: Vertex, options: WorthOptions = {}): Quantity<"m"> {
  return quantity(vertex.height, "m", [[{ vertex, gradient: axesAt(vertex).up }]], options);
}
