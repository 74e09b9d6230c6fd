import { requireKind } from "../errors/arguments.js";
import { covariance } from "./covariance.js";
import { symmetricEigen } from "./eigen.js";

/** The plane nearest to a set of points. */
export interface FittedPlane {
  /** A point of it: the mean of the points, 3 values. */
  readonly centre: Float64Array;
  /** Unit vector, upward (z not negative). Any direction across it where the points lie on a line or in one place. */
  readonly normal: Float64Array;
  /** Root mean square distance of the points from the plane, in their unit. */
  readonly deviation: number;
  /**
   * Variances along the principal axes, ascending, never negative. One zero: a plane without noise; two: a line;
   * three: one place.
   */
  readonly variances: Float64Array;
}

/**
 * Total least squares: the plane with the least sum of squared distances goes through the mean, across the direction of
 * least variance (Pearson, "On lines and planes of closest fit", Phil. Mag. 2 (1901) 559–572).
 *
 * @param points x, y, z of each, any unit; three or more make a plane
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function fitPlane(points: ArrayLike<number>): FittedPlane {
  requireKind(points, "numbers", "fitPlane: points");
  const { mean, matrix } = covariance(points);
  const { values, vectors } = symmetricEigen(matrix);
  // Rounding may leave a variance of zero a little below.
  const variances = values.map((value) => Math.max(0, value));
  const side = vectors[2] < 0 ? -1 : 1;
  return {
    centre: mean,
    normal: vectors.subarray(0, 3).map((component) => side * component),
    deviation: Math.sqrt(variances[0]),
    variances,
  };
}
