/** Three numbers along the axes of one Cartesian frame. */
export type Vector = readonly [number, number, number];

/** a · b */
export function dot(a: ArrayLike<number>, b: ArrayLike<number>): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** a − b */
export function difference(a: ArrayLike<number>, b: ArrayLike<number>): Vector {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

/** a × b */
export function cross(a: ArrayLike<number>, b: ArrayLike<number>): Vector {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** a / |a|; not a number for the vector 0. */
export function unit(a: ArrayLike<number>): Vector {
  const length = Math.hypot(a[0], a[1], a[2]);
  return [a[0] / length, a[1] / length, a[2] / length];
}
