import type { TerrainStation } from "../terrain/terrain-line.js";

/** A place in a profile: chainage and height. */
export type PlotPlace = readonly [chainage: number, height: number];

/** What lies between two places of a profile. */
export interface PlotDistance {
  /** Along the line; negative where the second place lies before the first. */
  readonly along: number;
  /** Upwards. */
  readonly up: number;
  /** Straight, in the unrolled plane of the profile. */
  readonly slant: number;
  /** Rise by length: 0.05 is 5 %; infinite where it is upright, NaN of one place twice. */
  readonly grade: number;
  /** Above the horizontal, radians, from -π/2 to π/2. */
  readonly angle: number;
}

/** @param a both in the same unit along and up, as `b` */
export function distanceInPlot(a: PlotPlace, b: PlotPlace): PlotDistance {
  const [along, up] = [b[0] - a[0], b[1] - a[1]];
  return {
    ...{ along, up, slant: Math.hypot(along, up), grade: up / Math.abs(along) },
    angle: Math.atan2(up, Math.abs(along)),
  };
}

/** Areas on both sides of a line, in the product of both units. */
export interface PlotAreas {
  readonly above: number;
  readonly below: number;
  /** Length over which both lines are there. */
  readonly length: number;
}

/**
 * Areas between a terrain line and a height, from one chainage to another. The ground is straight between
 * neighbouring stations; over gaps there is no area.
 */
export function areaToDatum(
  stations: readonly TerrainStation[],
  datum: number,
  from: number,
  to: number,
): PlotAreas {
  return areasOf(pairsOf(stations, ({ height }) => height - datum, from, to));
}

/**
 * Areas between two terrain lines with the same stations, as two surveys of one place have: `above` where the second lies
 * above the first. Where one of them has a gap there is no area.
 *
 * @throws RangeError where the stations are not the same
 */
export function areaBetween(
  first: readonly TerrainStation[],
  second: readonly TerrainStation[],
  from = Number.NEGATIVE_INFINITY,
  to = Number.POSITIVE_INFINITY,
): PlotAreas {
  if (first.length !== second.length || first.some(({ chainage }, at) => chainage !== second[at].chainage))
    throw new RangeError("the two terrain lines have different stations");
  return areasOf(pairsOf(first, ({ height }, at) => second[at].height - height, from, to));
}

/** The least distance between what is above and what is below, where both are there. */
export interface Clearance {
  readonly chainage: number;
  /** Least height of what is above minus greatest of what is below, in one station. */
  readonly clearance: number;
}

/**
 * Clearance of wires over ground, of a bridge over a road: station by station, the least one.
 * @param below terrain line of the one class
 * @param above that of the other, with the same stations
 * @returns undefined where no station has both
 * @throws RangeError where the stations are not the same
 */
export function leastClearance(
  below: readonly TerrainStation[],
  above: readonly TerrainStation[],
): Clearance | undefined {
  if (below.length !== above.length) throw new RangeError("the two terrain lines have different stations");
  let found: Clearance | undefined;
  for (const [at, { chainage, greatest, count }] of below.entries()) {
    const upper = above[at];
    if (upper.chainage !== chainage) throw new RangeError("the two terrain lines have different stations");
    if (count === 0 || upper.count === 0) continue;
    const clearance = upper.least - greatest;
    if (!found || clearance < found.clearance) found = { chainage, clearance };
  }
  return found;
}

/** Grade from each station to the next: rise by length; NaN over a gap. One fewer than the stations. */
export function gradesOf(stations: readonly TerrainStation[]): number[] {
  return stations.slice(1).map(({ chainage, height }, at) => {
    const before = stations[at];
    return (height - before.height) / (chainage - before.chainage);
  });
}

/** A stretch between neighbouring stations: its length, and the differences at both ends. */
interface Stretch {
  readonly length: number;
  readonly first: number;
  readonly second: number;
}

/** Stretches of a difference between two chainages, cut off where these lie within one. */
function pairsOf(
  stations: readonly TerrainStation[],
  difference: (station: TerrainStation, at: number) => number,
  from: number,
  to: number,
): Stretch[] {
  const [low, high] = [Math.min(from, to), Math.max(from, to)];
  return stations.slice(1).flatMap((station, at): Stretch[] => {
    const before = stations[at];
    const [first, second] = [difference(before, at), difference(station, at + 1)];
    const begin = Math.max(low, before.chainage);
    const end = Math.min(high, station.chainage);
    if (!(end > begin) || !Number.isFinite(first + second)) return [];
    const whole = station.chainage - before.chainage;
    const value = (chainage: number) => first + ((second - first) * (chainage - before.chainage)) / whole;
    return [{ length: end - begin, first: value(begin), second: value(end) }];
  });
}

function areasOf(stretches: readonly Stretch[]): PlotAreas {
  let [above, below, length] = [0, 0, 0];
  for (const { first, second, length: along } of stretches) {
    length += along;
    if (first * second >= 0) {
      const area = ((first + second) / 2) * along;
      if (area > 0) above += area;
      else below -= area;
      continue;
    }
    // Where the lines cross, two triangles.
    const share = first / (first - second);
    const [one, other] = [
      (Math.abs(first) * share * along) / 2,
      (Math.abs(second) * (1 - share) * along) / 2,
    ];
    above += first > 0 ? one : other;
    below += first > 0 ? other : one;
  }
  return { above, below, length };
}
