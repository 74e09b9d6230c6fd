import { type AccuracyPart, WGS84 } from "@groma/georef";
import { MeasureError } from "../../../errors/index.js";
import { shown } from "../../../options/index.js";
import type { MeasuredCloud } from "../vertex/vertex.js";

/** Standard deviation of recorded points, metres: along each axis, or in plane (each axis) and height. */
export type Precision = number | { readonly horizontal: number; readonly vertical: number };

/** What a caller knows of the points. */
export interface WorthOptions {
  /**
   * The scanner's precision, one standard deviation: for all points, or by data set. What is not given is unknown, and
   * with it the worth of every value.
   */
  readonly precision?: Precision | ((cloud: MeasuredCloud) => Precision | undefined) | undefined;
}

/** One reason why a point is not where it is said to be. */
export interface PointError {
  readonly name: string;
  /** Standard uncertainties in plane (along each axis) and along the vertical, metres. */
  readonly horizontal: number;
  readonly up: number;
  /** False: nobody has stated it, and the two numbers are what it may reach. */
  readonly known: boolean;
  /**
   * Metres over which the errors of two points of one data set grow apart: 0, each point has its own; Infinity, all
   * have the same one.
   */
  readonly reach: number;
  readonly shape: "normal" | "rectangular";
  /** Whether the recorded coordinates themselves have it, or only the place that was derived from them. */
  readonly of: "record" | "place";
  readonly note?: string | undefined;
}

/** Errors of datum operations and geoids change smoothly: two points grow apart by u · distance / reach. */
const DATUM_REACH = 100_000;
const GEOID_REACH = 200_000;

/**
 * What a datum operation that nobody has stated may be off by, as a standard uncertainty (metres), and the stretch of
 * distances that this stands for: 1e-4, more than the axes of any two ellipsoids in use differ by.
 */
const UNSTATED = { size: 100, reach: 1_000_000 };

/** Heights of unknown reference: undulations of the geoid run from −107 to 85 m, its slope to about 1e-4. */
const UNKNOWN_HEIGHT = { size: 62, reach: 600_000 };

/** The errors of the points of one data set. */
export interface CloudErrors {
  /** Each point's own, of points that are records, and of places that are none. */
  readonly ofRecords: readonly PointError[];
  readonly ofPlaces: readonly PointError[];
  /** Those that its points have in common, near ones more than far ones. */
  readonly shared: readonly PointError[];
}

const NOT_AT_HAND = unknownPlace("the place is not one of a data set at hand");
const NO_CLOUD: CloudErrors = { ofRecords: [NOT_AT_HAND], ofPlaces: [NOT_AT_HAND], shared: [] };

const known = new WeakMap<MeasuredCloud, { precision: Precision | undefined; errors: CloudErrors }>();

/** The errors of a data set's points, worked out once; those of places that belong to none are unknown. */
export function cloudErrors(cloud: MeasuredCloud | undefined, given: WorthOptions["precision"]): CloudErrors {
  if (!cloud) return NO_CLOUD;
  const precision = typeof given === "function" ? given(cloud) : given;
  const found = known.get(cloud);
  if (found && found.precision === precision) return found.errors;
  checkPrecision(precision, cloud.name);
  const step = quantisation(cloud);
  const placed = cloud.accuracy.parts.flatMap((part) => placeError(part, cloud));
  const own = placed.filter(({ reach }) => reach === 0);
  const errors: CloudErrors = {
    ofRecords: [step, precisionError(precision), ...own],
    ofPlaces: [step, unknownPlace("the vertex is no record of the scan"), ...own],
    shared: placed.filter(({ reach }) => reach > 0),
  };
  known.set(cloud, { precision, errors });
  return errors;
}

/** @throws MeasureError MEASURE_OPTION where it is no standard deviation */
export function checkPrecision(given: unknown, file: string): void {
  const isLength = (one: unknown) => typeof one === "number" && one >= 0 && Number.isFinite(one);
  if (given === undefined || isLength(given)) return;
  const both = typeof given === "object" && given !== null ? (given as Record<string, unknown>) : {};
  if (isLength(both.horizontal) && isLength(both.vertical)) return;
  throw new MeasureError({
    code: "MEASURE_OPTION",
    file,
    cause: `the precision of its points cannot be ${shown(given)}`,
    fix: "give one standard deviation in metres, from 0 on, or { horizontal, vertical }, or leave it out where it is not known",
  });
}

/**
 * Half a step of the integers either way, evenly likely. In plane the coarser axis counts for both: the grid is turned
 * against east and north.
 */
function quantisation({ crs: { horizontalUnit, verticalUnit }, scale }: MeasuredCloud): PointError {
  const metres = horizontalUnit.size * (horizontalUnit.kind === "angular" ? WGS84.a : 1);
  const deviation = (step: number) => step / Math.sqrt(12);
  return {
    ...{ name: "quantisation", known: true, reach: 0, shape: "rectangular", of: "record" },
    horizontal: deviation(Math.max(scale[0], scale[1]) * metres),
    up: deviation(scale[2] * Math.abs(verticalUnit.size)),
    note: "rounding to the stored integers",
  };
}

function precisionError(given: Precision | undefined): PointError {
  const own = { name: "point precision", reach: 0, shape: "normal", of: "record" } as const;
  if (given === undefined) {
    return { ...own, horizontal: 0, up: 0, known: false, note: "the scanner's; not given" };
  }
  const { horizontal, vertical } = typeof given === "number" ? { horizontal: given, vertical: given } : given;
  return { ...own, horizontal, up: vertical, known: true, note: "as given" };
}

function unknownPlace(note: string): PointError {
  return {
    ...{ name: "place", horizontal: 0, up: 0, known: false, reach: 0, shape: "normal", of: "record" },
    note,
  };
}

/** A stated part of a data set's accuracy as an error of its points. Stated accuracies count as one deviation. */
function placeError({ name, metres, note }: AccuracyPart, { bounds }: MeasuredCloud): PointError[] {
  const common = { name, shape: "normal", of: "place", ...(note !== undefined && { note }) } as const;
  const known = metres !== null;
  switch (name) {
    // Counted above, by axis; and vertices stand at their exact places, not where a fit draws them.
    case "quantisation":
    case "fit":
      return [];
    case "datum operation": {
      const { size, reach } = known ? { size: metres, reach: DATUM_REACH } : UNSTATED;
      return [{ ...common, known, reach, horizontal: size, up: size }];
    }
    case "height": {
      const { size, reach } = known ? { size: metres, reach: GEOID_REACH } : UNKNOWN_HEIGHT;
      return size === 0 ? [] : [{ ...common, known, reach, horizontal: 0, up: size }];
    }
    // A rigid body with the scale that it was given: where it stands does not stretch it.
    case "anchor":
      return [
        { ...common, known, reach: Number.POSITIVE_INFINITY, horizontal: metres ?? 1, up: metres ?? 1 },
      ];
    // Residuals of the fit: over the data set its rotation and scale may be off by as much.
    case "control points":
      return [{ ...common, known, reach: bounds.radius, horizontal: metres ?? 1, up: metres ?? 1 }];
    default:
      return [{ ...common, known, reach: 0, horizontal: metres ?? 0, up: metres ?? 0 }];
  }
}
