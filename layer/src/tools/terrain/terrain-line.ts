/** How the height of a station follows from those of its points: one of them, their mean, or a percentile of them, 0 to 100. */
export type TerrainStatistic = "min" | "max" | "mean" | number;

/** How a terrain line is made. */
export interface TerrainOptions {
  /** Distance between stations, in the unit of the chainage. */
  readonly interval: number;
  /** Default: 25, the percentile below which a quarter of the heights are. */
  readonly statistic?: TerrainStatistic | undefined;
}

/** One station of a terrain line. */
export interface TerrainStation {
  /** Of its middle: points up to half the interval before and behind it count. */
  readonly chainage: number;
  /** By the statistic; NaN where no point is. */
  readonly height: number;
  readonly least: number;
  readonly greatest: number;
  readonly mean: number;
  /** Standard deviation of the heights of the points; NaN of fewer than two. */
  readonly deviation: number;
  /** Number of points. */
  readonly count: number;
}

/** Stations at most. */
const MOST = 10_000_000;

/**
 * Number of stations of a terrain line.
 * @throws RangeError where the interval is none, or too small for the length
 */
export function terrainStations(from: number, to: number, interval: number): number {
  const count = Math.floor((to - from) / interval + 1e-9) + 1;
  if (interval > 0 && count >= 1 && count <= MOST) return count;
  throw new RangeError(`the interval of the terrain line cannot be ${interval}`);
}

/**
 * The ground along a line, station by station, from points in any order. Stations without points are gaps: nothing is
 * drawn between their neighbours.
 */
export class TerrainLine {
  readonly interval: number;
  readonly statistic: TerrainStatistic;
  readonly #from: number;
  readonly #count: Uint32Array;
  /** Of each station least, greatest, mean and the sum of squares of what is left of it, by Welford's recurrence. */
  readonly #moments: Float64Array;
  /** All heights of each station, where a percentile is asked for. */
  readonly #heights: Float64Array[] | undefined;

  /**
   * @param from chainage of the first station
   * @param to chainage up to which stations are made
   * @throws RangeError where the interval is none, too small for the length, or the statistic none
   */
  constructor(from: number, to: number, { interval, statistic = 25 }: TerrainOptions) {
    const count = terrainStations(from, to, interval);
    if (typeof statistic === "number" && !(statistic >= 0 && statistic <= 100))
      throw new RangeError(`there is no percentile ${statistic}`);
    this.interval = interval;
    this.statistic = statistic;
    this.#from = from;
    this.#count = new Uint32Array(count);
    this.#moments = new Float64Array(4 * count);
    this.#heights = typeof statistic === "number" ? new Array(count) : undefined;
  }

  /** Takes a point into the station that is nearest to it, of two the one behind; points beyond are passed over. */
  add(chainage: number, height: number): void {
    const station = Math.floor((chainage - this.#from) / this.interval + 0.5);
    if (!(station >= 0 && station < this.#count.length)) return;
    const count = ++this.#count[station];
    const moments = this.#moments;
    const at = 4 * station;
    if (count === 1 || height < moments[at]) moments[at] = height;
    if (count === 1 || height > moments[at + 1]) moments[at + 1] = height;
    const difference = height - moments[at + 2];
    moments[at + 2] += difference / count;
    moments[at + 3] += difference * (height - moments[at + 2]);
    if (this.#heights) this.#keep(this.#heights, station, count, height);
  }

  #keep(heights: Float64Array[], station: number, count: number, height: number): void {
    let kept = heights[station];
    if (!kept || kept.length < count) {
      const larger = new Float64Array(Math.max(8, 2 * count));
      if (kept) larger.set(kept);
      heights[station] = larger;
      kept = larger;
    }
    kept[count - 1] = height;
  }

  stations(): TerrainStation[] {
    return [...this.eachStation()];
  }

  /** The stations one after the other: a percentile of many points takes its time, and a page may pause between two. */
  *eachStation(): Generator<TerrainStation, void> {
    for (const [station, count] of this.#count.entries()) {
      const [least, greatest, mean, squares] = this.#moments.subarray(4 * station, 4 * station + 4);
      yield {
        chainage: this.#chainage(station),
        height: count === 0 ? Number.NaN : this.#height(station, count),
        ...(count === 0
          ? { least: Number.NaN, greatest: Number.NaN, mean: Number.NaN }
          : { least, greatest, mean }),
        deviation: count < 2 ? Number.NaN : Math.sqrt(squares / (count - 1)),
        count,
      };
    }
  }

  /** Chainage and height of the stations with points, a list for each stretch without a gap. */
  runs(): (readonly [chainage: number, height: number])[][] {
    const runs: (readonly [number, number])[][] = [];
    let open = false;
    for (let station = 0; station < this.#count.length; station++) {
      const count = this.#count[station];
      if (count > 0 && !open) runs.push([]);
      open = count > 0;
      if (open) runs[runs.length - 1].push([this.#chainage(station), this.#height(station, count)]);
    }
    return runs;
  }

  #chainage(station: number): number {
    return this.#from + station * this.interval;
  }

  #height(station: number, count: number): number {
    const { statistic } = this;
    if (typeof statistic === "number")
      return percentile(this.#heights![station].slice(0, count).sort(), statistic);
    return this.#moments[4 * station + MOMENTS.indexOf(statistic)];
  }
}

/** Where statistics stand among the moments of a station. */
const MOMENTS: readonly TerrainStatistic[] = ["min", "max", "mean"];

/** A percentile of sorted numbers, linear between two of them (Hyndman & Fan 1996, definition 7). */
function percentile(sorted: Float64Array, share: number): number {
  const at = ((sorted.length - 1) * share) / 100;
  const below = Math.floor(at);
  const above = Math.min(sorted.length - 1, below + 1);
  return sorted[below] + (at - below) * (sorted[above] - sorted[below]);
}
