/** Step of depth from which on a pixel counts: one hundredth, in the logarithm that Eye-Dome Lighting works with. */
const STEP = Math.log2(1.01);

/** Pixels that show a point, and those of them whose depth steps. */
export interface Silhouettes {
  readonly covered: number;
  readonly steps: number;
}

/**
 * Counts the pixels beside one of whose four neighbours depth steps by 1 % or more.
 * @param relief log2 of the eye depth of each pixel, row by row; NaN where there is no point, which is no step either
 */
export function silhouettesOf(relief: Float64Array, width: number): Silhouettes {
  let covered = 0;
  let steps = 0;
  for (let at = 0; at < relief.length; at++) {
    const own = relief[at];
    if (Number.isNaN(own)) continue;
    covered++;
    const column = at % width;
    const stepsTo = (beside: number) => Math.abs(relief[beside] - own) >= STEP;
    const across = (column > 0 && stepsTo(at - 1)) || (column < width - 1 && stepsTo(at + 1));
    // Beyond the first and last row there is nothing, which compares as false.
    if (across || stepsTo(at - width) || stepsTo(at + width)) steps++;
  }
  return { covered, steps };
}
