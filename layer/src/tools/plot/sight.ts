import type { TerrainStation } from "../terrain/terrain-line.js";
import type { PlotPlace } from "./plot-measures.js";

/** What bends sights against the heights of a profile. */
export interface SightOptions {
  /** Coefficient of refraction: how much of the earth's curvature the bent ray follows. Default: 0.13, Gauß' mean by day. */
  readonly refraction?: number | undefined;
  /** Radius of the earth, metres. Default: 6,371,008.8, the mean one (IUGG). */
  readonly radius?: number | undefined;
}

/** Gauß' mean coefficient of refraction. */
export const REFRACTION = 0.13;

/** Mean radius of the earth, metres (IUGG). */
const EARTH_RADIUS = 6_371_008.8;

/**
 * How far a level sight lies above the surface of equal height where it ends, metres: d² (1 − k) / 2R, of curvature and
 * refraction together. Good to 0.3 % for the radius, and to what refraction really is.
 * @param length of the sight, metres
 */
export function sightRise(
  length: number,
  { refraction = REFRACTION, radius = EARTH_RADIUS }: SightOptions = {},
): number {
  return (length ** 2 * (1 - refraction)) / (2 * radius);
}

/**
 * The line of sight between two places of a profile: in a plot, whose heights follow the earth, it sags below the straight
 * line between them.
 * @returns its height at a chainage, metres
 */
export function sightBetween(
  a: PlotPlace,
  b: PlotPlace,
  options: SightOptions = {},
): (chainage: number) => number {
  const length = b[0] - a[0];
  return (chainage) => {
    const before = chainage - a[0];
    const straight = a[1] + (length === 0 ? 0 : ((b[1] - a[1]) * before) / length);
    return straight - sightRise(1, options) * before * (b[0] - chainage);
  };
}

/** The least height of a sight above the ground, and where that is. */
export interface SightClearance {
  readonly chainage: number;
  /** Metres; below 0 where the ground stands in the way. */
  readonly clearance: number;
}

/**
 * The least clearance of a sight over the greatest heights of the stations that it passes.
 * @returns undefined where it passes no station with points
 */
export function sightClearance(
  stations: readonly TerrainStation[],
  a: PlotPlace,
  b: PlotPlace,
  options: SightOptions = {},
): SightClearance | undefined {
  const height = sightBetween(a, b, options);
  const [from, to] = [Math.min(a[0], b[0]), Math.max(a[0], b[0])];
  let least: SightClearance | undefined;
  for (const { chainage, greatest, count } of stations) {
    if (count === 0 || chainage <= from || chainage >= to) continue;
    const clearance = height(chainage) - greatest;
    if (!least || clearance < least.clearance) least = { chainage, clearance };
  }
  return least;
}
