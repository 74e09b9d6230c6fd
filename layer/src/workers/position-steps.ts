/** Steps to either side of a node's origin: a sign and 20 bits for each coordinate, 8 bytes for three. */
const STEPS = 2 ** 20 - 1;

/** Power of two of the shortest step, metres: a nanometre is finer than any place is known. */
const SHORTEST = -30;

/**
 * The length that coordinates up to a reach are counted in, metres: a power of two, so that float32 holds all multiples of it
 * up to the reach, and shaders get them back without an error.
 */
export function stepOver(reach: number): number {
  return 2 ** Math.max(SHORTEST, Math.ceil(Math.log2(reach / STEPS)));
}

/** Greatest distance of a place from the nearest one at whole steps, metres: half the diagonal of a cube of one step. */
export function stepBound(step: number): number {
  return (Math.sqrt(3) / 2) * step;
}

/** Greatest coordinate of a box, whatever its sign. */
export function reachOf(box: ArrayLike<number>): number {
  let reach = 0;
  for (let at = 0; at < box.length; at++) reach = Math.max(reach, Math.abs(box[at]));
  return reach;
}

/** Moves each coordinate to the nearest whole step. */
export function toSteps(positions: Float32Array, step: number): void {
  const perMetre = 1 / step;
  for (let at = 0; at < positions.length; at++) positions[at] = Math.round(positions[at] * perMetre) * step;
}
