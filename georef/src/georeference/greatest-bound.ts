import type { Domain } from "../cartesian/domain.js";
import type { Truth } from "../engines/truth.js";
import { PlacementError } from "../errors/errors.js";
import { fitPlacement } from "./fit.js";

/**
 * How far a drawn point of a data set may be from its exact place, metres: the tolerance, but for data sets so wide that
 * float32 alone costs more in their greatest nodes. The tolerance where part of the bounds has no place.
 *
 * @param domain bounds of the points, source units
 * @throws PlacementError PLACE_TOLERANCE
 */
export function greatestBound(truth: Truth, domain: Domain, tolerance: number, file?: string): number {
  try {
    return Math.max(tolerance, fitPlacement(truth, domain, tolerance, file).bound);
  } catch (thrown) {
    // Whoever places the points finds the same, and says it better.
    if (thrown instanceof PlacementError && thrown.code === "PLACE_DOMAIN") return tolerance;
    throw thrown;
  }
}
