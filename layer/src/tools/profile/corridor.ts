import type { BoxRelation, QueryVolume } from "../../query/index.js";
import { Strip } from "./strip.js";

/** How distances along a line are counted, and what curve it stands for. */
export interface Stationing {
  /** Lengths of the stretches between the vertices, in any unit. Default: in the plane. */
  readonly lengths?: readonly number[] | undefined;
  /** Chainage at the start of the line, in the same unit. Default: 0. */
  readonly start?: number | undefined;
  /**
   * Of each stretch that is the chord of a curve, the directions at its ends: radians from the x axis, counter-clockwise, the second
   * without a jump of a turn. Default: all are straight.
   */
  readonly headings?: readonly (readonly [from: number, to: number] | undefined)[] | undefined;
}

/** Chainages beyond which float64 no longer tells tenths of a millimetre apart. */
const MOST_START = 1e12;

/** A place on a line. */
export interface LinePlace {
  /** Source units. */
  readonly x: number;
  readonly y: number;
  /** Unit vector. */
  readonly direction: readonly [number, number];
}

/**
 * The strip along a polyline in the plane of the source coordinates: all points no farther than half the width from the
 * line. It ends squarely, where the line does, however short its last piece is: what is nearest to an end, and lies beyond it, is
 * left out. Joints are mitred on the inner side (the border of two segments is the bisector of their angle) and round on the outer
 * one.
 *
 * Each point belongs to the part of the line that is nearest to it, the earlier one where two are as near: so no point is
 * taken twice or lost, whatever the angles are and wherever the line crosses itself. What is nearest to a corner alone lies to the
 * right of a turn to the left. Whether a point lies in the strip is decided without any rounding, on the float64 coordinates of
 * the point and of the line.
 */
export class Corridor implements QueryVolume {
  /** x and y of the line's vertices, source units, as they were given. */
  readonly vertices: readonly (readonly [number, number])[];
  /** Chainage of each vertex. */
  readonly chainages: readonly number[];
  /** Half the width, source units. */
  readonly reach: number;
  readonly #strip: Strip;
  /** Chainage at the start of each segment, and at the end of the last. */
  readonly #stations: Float64Array;
  /** Directions of the curves that segments are chords of. */
  readonly #headings: (readonly [from: number, to: number] | undefined)[] = [];

  /**
   * @param line x and y of each vertex, source units; vertices that repeat the one before are passed over
   * @param width of the whole strip, source units
   * @throws RangeError where the line has no length, beside its start or at all, or a number is not finite
   */
  constructor(
    line: readonly (readonly [number, number])[],
    width: number,
    { lengths, start = 0, headings }: Stationing = {},
  ) {
    if (!(width > 0 && Number.isFinite(width))) throw new RangeError(`the width cannot be ${width}`);
    if (!(Math.abs(start) <= MOST_START)) throw new RangeError(`chainage cannot start at ${start}`);
    const ends: number[] = [];
    const stations = [start];
    const chainages = [start];
    for (let index = 1; index < line.length; index++) {
      const [ax, ay] = line[index - 1];
      const [bx, by] = line[index];
      if (![ax, ay, bx, by].every(Number.isFinite))
        throw new RangeError("a vertex of the line is not finite");
      if (ax === bx && ay === by) {
        chainages.push(stations[stations.length - 1]);
        continue;
      }
      ends.push(ax, ay, bx, by);
      this.#headings.push(headings?.[index - 1]);
      stations.push(stations[stations.length - 1] + (lengths?.[index - 1] ?? Math.hypot(bx - ax, by - ay)));
      chainages.push(stations[stations.length - 1]);
    }
    const length = stations[stations.length - 1] - start;
    if (ends.length === 0 || !(length > 0 && Number.isFinite(length)))
      throw new RangeError("the line has no length");
    this.vertices = line;
    this.chainages = chainages;
    this.reach = width / 2;
    this.#strip = new Strip(Float64Array.from(ends), this.reach, true);
    this.#stations = Float64Array.from(stations);
  }

  /** Length of the line, in the unit of its distances. */
  get length(): number {
    return this.#stations[this.#stations.length - 1] - this.#stations[0];
  }

  contains(x: number, y: number): boolean {
    return this.#strip.contains(x, y);
  }

  toBox(box: Float64Array): BoxRelation {
    return this.#strip.toBox(box);
  }

  /**
   * Finds the part of the line that a point of the strip belongs to.
   * @param out receives chainage and offset
   * @returns the number of the segment; -1 for a point that lies beyond the strip, whose numbers are NaN then
   */
  locate(x: number, y: number, out: Float64Array): number {
    const { segments } = this.#strip;
    const { members, begin, end } = this.#strip.near(x, y);
    let [found, nearest] = [-1, Number.POSITIVE_INFINITY];
    out[0] = Number.NaN;
    out[1] = Number.NaN;
    for (let at = begin; at < end; at++) {
      const segment = members[at];
      const from = 4 * segment;
      const ax = segments[from];
      const ay = segments[from + 1];
      const ux = segments[from + 2] - ax;
      const uy = segments[from + 3] - ay;
      const vx = x - ax;
      const vy = y - ay;
      const square = ux * ux + uy * uy;
      const share = (ux * vx + uy * vy) / square;
      if (this.#isElsewhere(segment, share, x, y)) continue;
      const foot = Math.min(1, Math.max(0, share));
      // Each end is measured from itself, so that both segments of a joint find the same distance.
      const dx = foot === 1 ? x - segments[from + 2] : vx - foot * ux;
      const dy = foot === 1 ? y - segments[from + 3] : vy - foot * uy;
      const inside = foot > 0 && foot < 1;
      const distance = inside
        ? Math.abs(ux * vy - uy * vx) / Math.sqrt(square)
        : Math.sqrt(dx * dx + dy * dy);
      if (!(distance < nearest)) continue;
      [found, nearest] = [segment, distance];
      const length = this.#stations[segment + 1] - this.#stations[segment];
      out[0] = this.#stations[segment] + foot * length;
      const across = this.#turnPast(segment, share) || ux * vy - uy * vx;
      out[1] = across < 0 ? -distance : distance;
    }
    return found;
  }

  /**
   * On which side a point lies that is nearest to a joint, and beside neither of its segments: the outer one, however sharply the
   * line turns there.
   * @param share foot of the point on the segment
   * @returns above 0 on the left; 0 for points beside the segment, and where the line turns back
   */
  #turnPast(segment: number, share: number): number {
    const slack = this.#slack(segment);
    if (share >= -slack && share <= 1 + slack) return 0;
    const from = 4 * (share < 0 ? segment - 1 : segment);
    const [ax, ay, bx, by, , , cx, cy] = this.#strip.segments.subarray(from, from + 8);
    return (by - ay) * (cx - bx) - (bx - ax) * (cy - by);
  }

  /**
   * Whether a point lies before the start of a segment, or behind its end, and is not nearest to the joint there: it belongs to
   * a part beyond, or lies past the end of the line. Beyond what rounding may do.
   */
  #isElsewhere(segment: number, share: number, x: number, y: number): boolean {
    if (share >= 0 && share <= 1) return false;
    const slack = this.#slack(segment);
    if (share < -slack) return segment === 0 || this.#share(segment - 1, x, y) < 1 - this.#slack(segment - 1);
    if (share <= 1 + slack) return false;
    const next = segment + 1;
    return 4 * next === this.#strip.segments.length || this.#share(next, x, y) > this.#slack(next);
  }

  /** What rounding may do to a share of a segment, of points within reach of it. */
  #slack(segment: number): number {
    const [ax, ay, bx, by] = this.#strip.segments.subarray(4 * segment, 4 * segment + 4);
    return 1e-12 * (1 + this.reach / Math.hypot(bx - ax, by - ay));
  }

  /** The foot of a point on a segment and beyond it: 0 at its start, 1 at its end. */
  #share(segment: number, x: number, y: number): number {
    const [ax, ay, bx, by] = this.#strip.segments.subarray(4 * segment, 4 * segment + 4);
    const [ux, uy] = [bx - ax, by - ay];
    return (ux * (x - ax) + uy * (y - ay)) / (ux * ux + uy * uy);
  }

  /**
   * The place of a chainage on the line, and the direction there of the line, or of the curve that it stands for: at a corner
   * the one between those of both segments, of which the earlier one counts where the line turns back.
   * @returns x, y and the unit vector of the direction; undefined beyond the ends of the line
   */
  at(chainage: number): LinePlace | undefined {
    const stations = this.#stations;
    const last = stations.length - 1;
    if (!(chainage >= stations[0] && chainage <= stations[last])) return undefined;
    let segment = 0;
    while (segment < last - 1 && chainage >= stations[segment + 1]) segment++;
    const [ax, ay, bx, by] = this.#strip.segments.subarray(4 * segment, 4 * segment + 4);
    const share = (chainage - stations[segment]) / (stations[segment + 1] - stations[segment]);
    const [x, y] = share === 1 ? [bx, by] : [ax + share * (bx - ax), ay + share * (by - ay)];
    const here = this.#direction(segment, share);
    if (share > 0 || segment === 0) return { x, y, direction: here };
    const before = this.#direction(segment - 1, 1);
    const [dx, dy] = [before[0] + here[0], before[1] + here[1]];
    const length = Math.hypot(dx, dy);
    return { x, y, direction: length < 1e-9 ? before : [dx / length, dy / length] };
  }

  /** The direction at a share of a segment; a curve turns evenly along its chord. */
  #direction(segment: number, share: number): readonly [number, number] {
    const headings = this.#headings[segment];
    if (headings) {
      const [from, to] = headings;
      const heading = from + share * (to - from);
      return [Math.cos(heading), Math.sin(heading)];
    }
    const [ax, ay, bx, by] = this.#strip.segments.subarray(4 * segment, 4 * segment + 4);
    const length = Math.hypot(bx - ax, by - ay);
    return [(bx - ax) / length, (by - ay) / length];
  }
}
