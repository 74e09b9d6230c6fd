import type { PointTransform } from "./link.js";
import type { Rectangle } from "./rectangle.js";

/** Writes ECEF and d ECEF / d (x, y, z) of a point. */
type Differentiable = (x: number, y: number, z: number, ecef: Float64Array, jacobian: Float64Array) => void;

/** Per direction; enough for a data set that goes round the earth to start within Newton's reach. */
const STARTS = 9;
/** Squared metres: where Newton's steps no longer matter, far below the micrometre promised. */
const CONVERGED = 1e-8 ** 2;
/** Squared metres: the promise. */
const PROMISED = 1e-6 ** 2;
const ITERATIONS = 50;

/** x, y, X, Y, Z of points spread over the domain, z = 0, those without a place left out. */
export function startingPoints(
  { minX, minY, maxX, maxY }: Rectangle,
  evaluate: PointTransform,
): Float64Array {
  const found: number[] = [];
  const ecef = new Float64Array(3);
  for (let i = 0; i < STARTS; i++) {
    for (let j = 0; j < STARTS; j++) {
      const x = minX + ((maxX - minX) * (i + 0.5)) / STARTS;
      const y = minY + ((maxY - minY) * (j + 0.5)) / STARTS;
      evaluate(x, y, 0, ecef, 0);
      if (ecef.every(Number.isFinite)) found.push(x, y, ...ecef);
    }
  }
  return Float64Array.from(found);
}

/**
 * Newton's iteration for the source coordinates of an ECEF point, from the nearest of the starting points. A step that
 * leaves the domain is cut off before its edge; one that does not come nearer (a kink, a hole of a grid) is halved.
 *
 * @returns whether a place within 1 µm was found; then it is in `out`
 */
export function invert(
  differentiate: Differentiable,
  domain: Rectangle,
  starts: Float64Array,
  target: readonly [number, number, number],
  out: Float64Array,
  offset: number,
): boolean {
  let [x, y] = nearest(starts, target);
  let z = 0;
  const ecef = new Float64Array(3);
  const jacobian = new Float64Array(9);
  const step = new Float64Array(3);
  const trial = new Float64Array(3);
  const trialJacobian = new Float64Array(9);
  const misfit = (at: Float64Array) =>
    (at[0] - target[0]) ** 2 + (at[1] - target[1]) ** 2 + (at[2] - target[2]) ** 2;

  differentiate(x, y, z, ecef, jacobian);
  let error = misfit(ecef);
  for (let i = 0; i < ITERATIONS && error > CONVERGED; i++) {
    solve(jacobian, [target[0] - ecef[0], target[1] - ecef[1], target[2] - ecef[2]], step);
    let share = 1;
    let better = false;
    while (share > 1e-3 && !better) {
      const nextX = within(domain.minX, domain.maxX, x, share * step[0]);
      const nextY = within(domain.minY, domain.maxY, y, share * step[1]);
      const nextZ = z + share * step[2];
      differentiate(nextX, nextY, nextZ, trial, trialJacobian);
      const nextError = misfit(trial);
      if (nextError < error) {
        better = true;
        x = nextX;
        y = nextY;
        z = nextZ;
        error = nextError;
        ecef.set(trial);
        jacobian.set(trialJacobian);
      }
      share /= 2;
    }
    if (!better) break;
  }
  if (!(error <= PROMISED)) return false;
  out[offset] = x;
  out[offset + 1] = y;
  out[offset + 2] = z;
  return true;
}

/** Share of the way to an edge that a step which leads beyond it goes: on the edge itself may lie a pole, without derivatives. */
const TOWARDS_EDGE = 0.9;

function within(least: number, greatest: number, from: number, step: number): number {
  if (from + step > greatest) return from + TOWARDS_EDGE * (greatest - from);
  if (from + step < least) return from + TOWARDS_EDGE * (least - from);
  return from + step;
}

function nearest(starts: Float64Array, target: readonly [number, number, number]): [number, number] {
  let least = Number.POSITIVE_INFINITY;
  let found: [number, number] = [Number.NaN, Number.NaN];
  for (let i = 0; i < starts.length; i += 5) {
    const squared =
      (starts[i + 2] - target[0]) ** 2 + (starts[i + 3] - target[1]) ** 2 + (starts[i + 4] - target[2]) ** 2;
    if (squared >= least) continue;
    least = squared;
    found = [starts[i], starts[i + 1]];
  }
  return found;
}

/** Solves a 3 × 3 system by Cramer's rule; its columns are nearly orthogonal here. */
function solve(m: Float64Array, [b0, b1, b2]: readonly [number, number, number], out: Float64Array): void {
  const c0 = m[4] * m[8] - m[5] * m[7];
  const c1 = m[5] * m[6] - m[3] * m[8];
  const c2 = m[3] * m[7] - m[4] * m[6];
  const determinant = m[0] * c0 + m[1] * c1 + m[2] * c2;
  out[0] = (b0 * c0 + b1 * (m[2] * m[7] - m[1] * m[8]) + b2 * (m[1] * m[5] - m[2] * m[4])) / determinant;
  out[1] = (b0 * c1 + b1 * (m[0] * m[8] - m[2] * m[6]) + b2 * (m[2] * m[3] - m[0] * m[5])) / determinant;
  out[2] = (b0 * c2 + b1 * (m[1] * m[6] - m[0] * m[7]) + b2 * (m[0] * m[4] - m[1] * m[3])) / determinant;
}
