import { coordinate } from "../errors/coordinates.js";
import { PlacementError } from "../errors/errors.js";
import { invert, startingPoints } from "../transformation/inverse.js";
import type { PointTransform } from "../transformation/link.js";
import { domainOf, type Rectangle } from "../transformation/rectangle.js";
import { pointTransform, type Truth } from "./truth.js";

/**
 * Where the map of a data set leads (ECEF, or the plane of a map; metres) → source coordinates, at `out[offset]` ….
 * The map of the result is within 1 µm of the point. Not reentrant.
 *
 * @throws PlacementError PLACE_DOMAIN where no source coordinates lead there
 */
export type SourceTransform = (x: number, y: number, z: number, out: Float64Array, offset?: number) => void;

/** Share of the data set's extent over which a derivative is taken, and the least one, of the coordinates themselves. */
const STEP = 1e-3;
const LEAST_STEP = 1e-6;
const ANYWHERE: Rectangle = { minX: -Infinity, minY: -Infinity, maxX: Infinity, maxY: Infinity };

/**
 * The inverse of a data set's map, by Newton's iteration.
 *
 * @param near box of the data set, source units: where the search begins. A function of proj4js and a similarity have an
 *   inverse beyond it, a transformation only in what it covers
 * @param file name for error messages
 */
export function sourceTransform(truth: Truth, near: Rectangle, file = "points"): SourceTransform {
  if (typeof truth !== "function" && truth.inverse) return truth.inverse;
  const evaluate = pointTransform(truth);
  const limits = typeof truth === "function" ? ANYWHERE : domainOf(truth.transformation);
  const differentiate = byDifferences(evaluate, near, limits);
  let starts: Float64Array | undefined;
  return (x, y, z, out, offset = 0) => {
    starts ??= startingPoints(near, evaluate);
    if (invert(differentiate, limits, starts, [x, y, z], out, offset)) return;
    throw new PlacementError({
      ...{ code: "PLACE_DOMAIN", file },
      cause: `no coordinates of this data set lead to (${[x, y, z].map(coordinate).join(", ")})`,
      fix: "check the point, in which coordinates it is given, and that it lies within the data set",
    });
  };
}

type Differentiable = Parameters<typeof invert>[0];

/** The map and its derivatives from central differences, one-sided at the edge of where it holds. */
function byDifferences(
  evaluate: PointTransform,
  { minX, minY, maxX, maxY }: Rectangle,
  limits: Rectangle,
): Differentiable {
  const size = Math.max(1, ...[minX, minY, maxX, maxY].map(Math.abs));
  const step = Math.max(STEP * (maxX - minX), STEP * (maxY - minY), LEAST_STEP * size);
  const [ahead, behind] = [new Float64Array(3), new Float64Array(3)];
  const column = (jacobian: Float64Array, at: number, distance: number) => {
    for (let row = 0; row < 3; row++) jacobian[3 * row + at] = (ahead[row] - behind[row]) / distance;
  };
  return (x, y, z, place, jacobian) => {
    const [west, east] = [Math.max(limits.minX, x - step), Math.min(limits.maxX, x + step)];
    evaluate(west, y, z, behind, 0);
    evaluate(east, y, z, ahead, 0);
    column(jacobian, 0, east - west);
    const [south, north] = [Math.max(limits.minY, y - step), Math.min(limits.maxY, y + step)];
    evaluate(x, south, z, behind, 0);
    evaluate(x, north, z, ahead, 0);
    column(jacobian, 1, north - south);
    evaluate(x, y, z - 1, behind, 0);
    evaluate(x, y, z + 1, ahead, 0);
    column(jacobian, 2, 2);
    evaluate(x, y, z, place, 0);
  };
}
