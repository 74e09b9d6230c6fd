import type { GridWindow } from "../grid/window.js";

/**
 * One step, compiled. The state is 3 numbers, what they mean is told at `Step`; NaN where there is no such place.
 * Both functions change their arguments in place and allocate nothing; a link is not reentrant.
 */
export interface Link {
  apply(state: Float64Array): void;
  /** As `apply`, and multiplies the Jacobian (9 numbers, row-major: d state_i / d source_j) by the step's own. */
  differentiate(state: Float64Array, jacobian: Float64Array): void;
}

/**
 * Source coordinates (source units) to ECEF (EPSG:4978, metres), float64. Writes X, Y, Z at `out[offset]` …, all NaN
 * where there is no such place. Allocates nothing; not reentrant.
 */
export type PointTransform = (x: number, y: number, z: number, out: Float64Array, offset: number) => void;

/** A link whose step uses a grid says where it looks it up. */
export interface GridLink extends Link {
  readonly window: GridWindow;
}

/** row_i ← a·row_i + b·row_j of a 3 × 3 row-major matrix. */
export function combine(matrix: Float64Array, i: number, a: number, j: number, b: number): void {
  for (let column = 0; column < 3; column++) {
    matrix[3 * i + column] = a * matrix[3 * i + column] + b * matrix[3 * j + column];
  }
}

/** matrix ← left · matrix, both 3 × 3 row-major. */
export function premultiply(left: ArrayLike<number>, matrix: Float64Array): void {
  for (let column = 0; column < 3; column++) {
    const x = matrix[column];
    const y = matrix[3 + column];
    const z = matrix[6 + column];
    for (let row = 0; row < 3; row++) {
      matrix[3 * row + column] = left[3 * row] * x + left[3 * row + 1] * y + left[3 * row + 2] * z;
    }
  }
}
