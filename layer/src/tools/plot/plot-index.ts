import type { ProfilePoints } from "../cut/profile.js";
import type { PlotView } from "./plot-view.js";

/** A point of a plot. */
export interface PlottedPoint<P extends PlottedPart = PlottedPart> {
  readonly points: P;
  /** Which of them. */
  readonly index: number;
}

/** Points as plots have them. */
export type PlottedPart = Pick<ProfilePoints, "chainage" | "height">;

/** Stretches of the chainages of one part. */
const BUCKETS = 256;

/** Points of one node, in the order of their chainage by stretches. */
interface Part<P> {
  readonly points: P;
  readonly least: number;
  readonly greatest: number;
  /** Where the stretches begin in `members`, and the last one's end. */
  readonly begins: Uint32Array;
  readonly members: Uint32Array;
}

/** Finds the points of a plot near a pixel; adding points takes time in proportion to their number. */
export class PlotIndex<P extends PlottedPart = PlottedPart> {
  readonly #parts: Part<P>[] = [];

  add(points: P): void {
    const { chainage } = points;
    if (chainage.length === 0) return;
    let [least, greatest] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
    for (const value of chainage) {
      if (value < least) least = value;
      if (value > greatest) greatest = value;
    }
    const begins = new Uint32Array(BUCKETS + 1);
    for (const value of chainage) begins[bucketOf(value, least, greatest) + 1]++;
    for (let bucket = 0; bucket < BUCKETS; bucket++) begins[bucket + 1] += begins[bucket];
    const next = begins.slice();
    const members = new Uint32Array(chainage.length);
    for (let point = 0; point < chainage.length; point++) {
      members[next[bucketOf(chainage[point], least, greatest)]++] = point;
    }
    this.#parts.push({ points, least, greatest, begins, members });
  }

  clear(): void {
    this.#parts.length = 0;
  }

  /**
   * The point whose dot is nearest to a pixel.
   * @param reach pixels around it in which one is looked for
   * @param shows whether a point is in the picture. Default: all are
   */
  nearest(
    view: PlotView,
    x: number,
    y: number,
    reach: number,
    shows: (points: P, index: number) => boolean = () => true,
  ): PlottedPoint<P> | undefined {
    const { from, to, low, high } = view.shown;
    const [along, up] = [view.width / (to - from), view.height / (high - low)];
    const [chainage, height] = view.placeOf(x, y);
    let found: PlottedPoint<P> | undefined;
    let closest = reach * reach;
    for (const part of this.#parts) {
      const [first, last] = [chainage - reach / along, chainage + reach / along];
      if (last < part.least || first > part.greatest) continue;
      const { points, begins, members } = part;
      const begin = begins[bucketOf(first, part.least, part.greatest)];
      const end = begins[bucketOf(last, part.least, part.greatest) + 1];
      for (let at = begin; at < end; at++) {
        const point = members[at];
        const dx = (points.chainage[point] - chainage) * along;
        const dy = (points.height[point] - height) * up;
        const square = dx * dx + dy * dy;
        if (square > closest || (square === closest && found) || !shows(points, point)) continue;
        closest = square;
        found = { points, index: point };
      }
    }
    return found;
  }
}

/** Stretch of a chainage; those beyond fall into the outer ones. */
function bucketOf(chainage: number, least: number, greatest: number): number {
  if (greatest === least) return 0;
  const bucket = Math.floor(((chainage - least) / (greatest - least)) * BUCKETS);
  return Math.min(BUCKETS - 1, Math.max(0, bucket));
}
