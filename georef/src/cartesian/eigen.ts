import { requireKind } from "../errors/arguments.js";
/** Eigenvalues of a symmetric 3 × 3 matrix, ascending, with orthonormal eigenvectors. */
export interface Eigen {
  /** 3 values. */
  readonly values: Float64Array;
  /** 9 values: vector i at 3i, of the eigenvalue at i. */
  readonly vectors: Float64Array;
}

/** Three are enough in practice; convergence is quadratic. */
const SWEEPS_MAX = 20;

/**
 * Cyclic Jacobi rotations (Golub, Van Loan, "Matrix Computations", 4th ed., section 8.5). Ten times slower than the
 * trigonometric formula, but small eigenvalues of nearly singular matrices keep their digits.
 *
 * @param matrix 9 values, symmetric
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function symmetricEigen(matrix: ArrayLike<number>): Eigen {
  requireKind(matrix, "numbers", "symmetricEigen: matrix");
  const a = Float64Array.from(matrix);
  /** Columns converge to the eigenvectors. */
  const v = Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1);
  for (let sweep = 0; sweep < SWEEPS_MAX; sweep++) {
    if (a[1] === 0 && a[2] === 0 && a[5] === 0) break;
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ] as const)
      rotate(a, v, p, q);
  }
  const order = [0, 1, 2].sort((i, j) => a[4 * i] - a[4 * j]);
  return {
    values: Float64Array.from(order, (i) => a[4 * i]),
    vectors: Float64Array.from(order.flatMap((i) => [v[i], v[3 + i], v[6 + i]])),
  };
}

/** Makes a_pq zero by a rotation in the plane of p and q. */
function rotate(a: Float64Array, v: Float64Array, p: number, q: number): void {
  const off = a[3 * p + q];
  if (off === 0) return;
  const theta = (a[4 * q] - a[4 * p]) / (2 * off);
  const t = Math.sign(theta || 1) / (Math.abs(theta) + Math.hypot(theta, 1));
  const c = 1 / Math.hypot(t, 1);
  const s = t * c;
  a[4 * p] -= t * off;
  a[4 * q] += t * off;
  a[3 * p + q] = a[3 * q + p] = 0;
  const r = 3 - p - q;
  const rp = a[3 * r + p];
  const rq = a[3 * r + q];
  a[3 * r + p] = a[3 * p + r] = c * rp - s * rq;
  a[3 * r + q] = a[3 * q + r] = s * rp + c * rq;
  for (let row = 0; row < 3; row++) {
    const vp = v[3 * row + p];
    const vq = v[3 * row + q];
    v[3 * row + p] = c * vp - s * vq;
    v[3 * row + q] = s * vp + c * vq;
  }
}
