/** A part of the picture whose points lie evenly. */
export interface Patch {
  /** Distance between its points, metres on the ground. */
  readonly spacing: number;
  /** What it takes of the picture, pixels. */
  readonly pixels: number;
}

/**
 * The distance between points that one size on the ground has to bridge: the median over the picture, 0 where there is
 * nothing. The finest level's would leave holes in all that is coarser, and most of a picture is, for points are chosen
 * to lie evenly on the screen; the coarsest's would lay the finer parts over one another many times.
 */
export function groundSpacing(patches: readonly Patch[]): number {
  const rising = [...patches].sort((a, b) => a.spacing - b.spacing);
  let left = 0.5 * rising.reduce((sum, { pixels }) => sum + pixels, 0);
  for (const { spacing, pixels } of rising) {
    left -= pixels;
    if (left <= 0) return spacing;
  }
  return rising.at(-1)?.spacing ?? 0;
}
