import { geometricTail, NODES } from "../approximation/chebyshev.js";
import type { Expansion } from "./expansion.js";
import { type FittedScheme, keeps } from "./scheme.js";

/**
 * Added to every bound, metres: below it the coefficients are rounding noise of the projections and say nothing
 * about the rest of the series.
 */
export const FLOOR = 5e-6;
function norm(c: Float64Array, at: number): number {
  return Math.hypot(c[at], c[at + 1], c[at + 2]);
}

/** Bound (metres) on what the 9 × 9 expansion itself leaves out. */
export function tailBound({ coefficients }: Expansion): number {
  return geometricTail((k, l) => {
    const at = (k * NODES + l) * 6;
    return norm(coefficients, at) + norm(coefficients, at + 3);
  });
}

/**
 * Certified error of a scheme over the whole domain, metres: norms of the coefficients that it discards
 * (|T_k| ≤ 1), the tail, and the floor.
 */
export function fitBound(expansion: Expansion, scheme: FittedScheme, tail: number): number {
  const { coefficients } = expansion;
  let discarded = 0;
  for (let k = 0; k < NODES; k++) {
    for (let l = 0; l < NODES; l++) {
      const at = (k * NODES + l) * 6;
      if (!keeps(scheme, "P", k, l)) discarded += norm(coefficients, at);
      if (!keeps(scheme, "n", k, l)) discarded += norm(coefficients, at + 3);
    }
  }
  return discarded + tail + FLOOR;
}

/**
 * Error of rounding node frame coordinates to float32, metres: half a unit in the last place of the largest
 * coordinate that the expansion can reach, per axis, taken together.
 *
 * @param beyond metres by which what is stored may exceed the expansion: its tail, and what grids add
 */
export function storageBound({ coefficients }: Expansion, beyond: number): number {
  let square = 0;
  for (let axis = 0; axis < 3; axis++) {
    let reach = beyond + FLOOR;
    for (let at = axis; at < coefficients.length; at += 3) reach += Math.abs(coefficients[at]);
    square += halfUlp32(reach) ** 2;
  }
  return Math.sqrt(square);
}

/** Half a unit in the last place of a float32 of this magnitude. */
export function halfUlp32(magnitude: number): number {
  return 2 ** (Math.floor(Math.log2(magnitude)) - 24);
}
