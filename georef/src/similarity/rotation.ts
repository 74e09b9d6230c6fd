/** Three are enough in practice; convergence is quadratic. */
const SWEEPS_MAX = 20;
const SIZE = 4;

/**
 * The rotation that turns points onto others best, in the sense of least squares: Horn, "Closed-form solution of absolute
 * orientation using unit quaternions", J. Opt. Soc. Am. A 4 (1987) 629–642, section 4. It is a proper rotation always, for
 * coplanar points too.
 *
 * @param s 9 values, s[3i + j] = Σ a_i b_j over the points a and their counterparts b, both about their means
 * @returns 9 values, row-major: b ≈ scale · R · a
 */
export function bestRotation(s: ArrayLike<number>): number[] {
  const [xx, xy, xz, yx, yy, yz, zx, zy, zz] = Array.from(s);
  const q = greatestEigenvector([
    [xx + yy + zz, yz - zy, zx - xz, xy - yx],
    [yz - zy, xx - yy - zz, xy + yx, zx + xz],
    [zx - xz, xy + yx, yy - xx - zz, yz + zy],
    [xy - yx, zx + xz, yz + zy, zz - xx - yy],
  ]);
  const length = Math.hypot(...q);
  const [w, x, y, z] = q.map((value) => value / length);
  return [
    ...[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
    ...[2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
    ...[2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
  ];
}

/** Of a symmetric 4 × 4 matrix, which is used up; by cyclic Jacobi rotations as in `cartesian/eigen`. */
function greatestEigenvector(a: number[][]): number[] {
  const v = a.map((_, i) => a.map((_, j) => (i === j ? 1 : 0)));
  for (let sweep = 0; sweep < SWEEPS_MAX; sweep++) {
    for (let p = 0; p < SIZE; p++) for (let q = p + 1; q < SIZE; q++) rotate(a, v, p, q);
  }
  let greatest = 0;
  for (let i = 1; i < SIZE; i++) if (a[i][i] > a[greatest][greatest]) greatest = i;
  return v.map((row) => row[greatest]);
}

/** Makes a_pq zero by a rotation in the plane of p and q (Golub, Van Loan, "Matrix Computations", section 8.5). */
function rotate(a: number[][], v: number[][], p: number, q: number): void {
  if (a[p][q] === 0) return;
  const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const t = Math.sign(theta || 1) / (Math.abs(theta) + Math.hypot(theta, 1));
  const c = 1 / Math.hypot(t, 1);
  const s = t * c;
  for (const matrix of [a, v]) {
    for (const row of matrix) {
      const [left, right] = [row[p], row[q]];
      row[p] = c * left - s * right;
      row[q] = s * left + c * right;
    }
  }
  for (let column = 0; column < SIZE; column++) {
    const [left, right] = [a[p][column], a[q][column]];
    a[p][column] = c * left - s * right;
    a[q][column] = s * left + c * right;
  }
  a[p][q] = a[q][p] = 0;
}
