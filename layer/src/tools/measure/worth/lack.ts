import { dot, type Vector } from "@groma/georef";

/** Vertices up to which each pair of them is looked at. */
const FEW = 8;

/** Extent of vertices over the reach of an error below which the error's covariance is a parabola, to 3e-4 of what it lacks. */
const NEAR = 0.025;

/** What the covariances of an error fall short of those of a common one, summed over all pairs; and the least correlation. */
export interface Lack {
  readonly lack: number;
  readonly correlation: number;
}

/**
 * @param places ECEF of vertices, metres
 * @param weights what an error does to a value at each of them
 * @param reach of the error: the covariance of two places is exp(−(d / reach)² / 2)
 */
export function lackOf(places: readonly Vector[], weights: readonly Vector[], reach: number): Lack {
  const isNear = places.length > FEW && extentOf(places) < NEAR * reach;
  return isNear ? lackNearby(places, weights, reach) : lackByPairs(places, weights, reach);
}

/** @internal */
export function lackByPairs(places: readonly Vector[], weights: readonly Vector[], reach: number): Lack {
  let [lack, correlation] = [0, 1];
  for (let i = 0; i < places.length; i++) {
    const [ax, ay, az] = places[i];
    for (let j = 0; j < i; j++) {
      const [bx, by, bz] = places[j];
      const square = ((ax - bx) ** 2 + (ay - by) ** 2 + (az - bz) ** 2) / reach ** 2;
      const short = -Math.expm1(-square / 2);
      lack += 2 * short * dot(weights[i], weights[j]);
      correlation = Math.min(correlation, 1 - short);
    }
  }
  return { lack, correlation };
}

/**
 * The same by moments, where 1 − exp(−d² / 2) is d² / 2: the sum over pairs of |pᵢ − pⱼ|² wᵢ·wⱼ is
 * Σ|p|² w · Σw − |Σ p wᵀ|². It takes as long as there are vertices, not pairs.
 */
function lackNearby(places: readonly Vector[], weights: readonly Vector[], reach: number): Lack {
  const [x0, y0, z0] = places[0];
  const products = new Float64Array(9);
  const [whole, squares] = [new Float64Array(3), new Float64Array(3)];
  for (const [i, at] of places.entries()) {
    const place = [at[0] - x0, at[1] - y0, at[2] - z0];
    const square = place[0] ** 2 + place[1] ** 2 + place[2] ** 2;
    for (let b = 0; b < 3; b++) {
      const weight = weights[i][b];
      whole[b] += weight;
      squares[b] += square * weight;
      for (let a = 0; a < 3; a++) products[3 * a + b] += place[a] * weight;
    }
  }
  const mixed = squares[0] * whole[0] + squares[1] * whole[1] + squares[2] * whole[2];
  const lack = (mixed - products.reduce((sum, one) => sum + one * one, 0)) / reach ** 2;
  return { lack, correlation: Math.exp(-((extentOf(places) / reach) ** 2) / 2) };
}

/** Diagonal of the box around vertices, metres: no two of them are farther apart. */
function extentOf(places: readonly Vector[]): number {
  const [least, most] = [[...places[0]], [...places[0]]];
  for (const place of places) {
    for (let axis = 0; axis < 3; axis++) {
      least[axis] = Math.min(least[axis], place[axis]);
      most[axis] = Math.max(most[axis], place[axis]);
    }
  }
  return Math.hypot(most[0] - least[0], most[1] - least[1], most[2] - least[2]);
}
