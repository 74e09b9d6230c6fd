/**
 * Where the sample scan lies: a square of the Lauterbrunnen valley in LV95. Everything in this folder works in
 * local metres (x east, y north of {@link ORIGIN}, z LN02 height); only the LAS writer adds the origin.
 */

/** Edge of the scanned square, metres. */
export const SIZE = 520;

/** Terrain known around the square, metres: slanted rays start and shadows fall from there. */
export const MARGIN = 60;

/** South-west corner of the square, LV95 metres (EPSG:2056). */
export const ORIGIN = { east: 2635680, north: 1159800 } as const;

/** No ground lies below or above these heights, LN02 metres. */
export const LOWEST = 780;
export const HIGHEST = 1030;

/** LN02 height of the valley floor at a distance y north of the origin: the valley falls to the north. */
export function floorHeight(y: number): number {
  return 802 - 0.012 * y;
}

/** True when the point lies within the scanned square. */
export function inside(x: number, y: number): boolean {
  return x >= 0 && y >= 0 && x < SIZE && y < SIZE;
}

/** Hermite step from 0 at `from` to 1 at `to`, with flat ends. */
export function smoothstep(from: number, to: number, value: number): number {
  const t = Math.min(1, Math.max(0, (value - from) / (to - from)));
  return t * t * (3 - 2 * t);
}
