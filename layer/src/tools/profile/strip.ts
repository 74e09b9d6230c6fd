import type { BoxRelation } from "../../query/index.js";
import { isAtJoint, isBeside } from "../exact/exact.js";
import { SegmentGrid, type Segments } from "./segment-grid.js";

/** Relative error of a float64 operation. */
const EPSILON = 2 ** -53;

/**
 * All points beside segments in the plane of the source coordinates, no farther than a distance, and the outer sides of the
 * joints between them: what is nearest to a joint. Whether a point is one is decided without any rounding, on the float64
 * coordinates of the point and of the segments.
 */
export class Strip {
  readonly segments: Segments;
  /** Half the width, source units. */
  readonly reach: number;
  /** Whether each segment begins where the one before ends. */
  readonly #joined: boolean;
  /** Of each segment the square of its length, and the length times the reach: what its cross product is held against. */
  readonly #squares: Float64Array;
  readonly #limits: Float64Array;
  readonly #grid: SegmentGrid;

  /** @param segments which have a length each @param joined whether each begins where the one before ends */
  constructor(segments: Segments, reach: number, joined: boolean) {
    this.segments = segments;
    this.reach = reach;
    this.#joined = joined;
    const count = segments.length / 4;
    this.#squares = Float64Array.from({ length: count }, (_, segment) => squareOf(segments, segment));
    this.#limits = this.#squares.map((square) => reach * Math.sqrt(square));
    this.#grid = new SegmentGrid(segments, reach);
  }

  /** Numbers of the segments that a point may be near, rising: those of `members` from `begin` to `end`. */
  near(x: number, y: number): Pick<SegmentGrid, "members" | "begin" | "end"> {
    this.#grid.at(x, y);
    return this.#grid;
  }

  contains(x: number, y: number): boolean {
    const { members, begin, end } = this.near(x, y);
    let doubt = false;
    for (let at = begin; at < end; at++) {
      const nearness = this.#nearness(members[at], x, y);
      if (nearness > 0) return true;
      doubt ||= nearness === 0;
    }
    if (!doubt) return false;
    for (let at = begin; at < end; at++) if (this.#isExactlyNear(members[at], x, y)) return true;
    return false;
  }

  /** Whether a point lies beside one segment, or at the joint behind it. */
  isNear(segment: number, x: number, y: number): boolean {
    const nearness = this.#nearness(segment, x, y);
    return nearness > 0 || (nearness === 0 && this.#isExactlyNear(segment, x, y));
  }

  /** How a box lies to all of it. */
  toBox(box: Float64Array): BoxRelation {
    const [minX, minY, , maxX, maxY] = box;
    // What rounding may take from the differences of coordinates.
    const slack = 16 * EPSILON * Math.max(Math.abs(minX), Math.abs(maxX), Math.abs(minY), Math.abs(maxY));
    const reach = this.reach * (1 + 16 * EPSILON) + slack;
    const { segments } = this;
    let met = false;
    for (let at = 0; at < segments.length; at += 4) {
      // Most of many segments are that far from a box on one axis alone.
      const [ax, bx] = [segments[at], segments[at + 2]];
      if (minX - Math.max(ax, bx) > reach || Math.min(ax, bx) - maxX > reach) continue;
      const [ay, by] = [segments[at + 1], segments[at + 3]];
      if (minY - Math.max(ay, by) > reach || Math.min(ay, by) - maxY > reach) continue;
      if (this.#covers(at / 4, box)) return "in";
      met ||= this.#gap(at / 4, box) <= reach;
    }
    return met ? "crossing" : "out";
  }

  /**
   * Above 0 where a point lies beside a segment or at the joint behind it, below where it does not, 0 where rounding leaves it
   * open.
   */
  #nearness(segment: number, x: number, y: number): number {
    const from = 4 * segment;
    const ax = this.segments[from];
    const ay = this.segments[from + 1];
    const ux = this.segments[from + 2] - ax;
    const uy = this.segments[from + 3] - ay;
    const vx = x - ax;
    const vy = y - ay;
    // Each product has an error of some units in the last place of its factors; 16 is generous.
    const across = Math.abs(ux * vy - uy * vx);
    const limit = this.#limits[segment];
    const left = limit - across;
    const uncertain = 16 * EPSILON * (Math.abs(ux * vy) + Math.abs(uy * vx) + limit);
    // What lies too far aside is too far from the joint as well.
    if (left < -uncertain) return -1;
    const length = this.#squares[segment];
    const along = ux * vx + uy * vy;
    const doubt = 16 * EPSILON * (Math.abs(ux * vx) + Math.abs(uy * vy) + length);
    if (along < -doubt) return -1;
    if (along > length + doubt) return this.#hasJoint(segment) ? this.#nearnessToJoint(segment, x, y) : -1;
    return left > uncertain && along > doubt && along < length - doubt ? 1 : 0;
  }

  /** The same of the joint behind a segment, for a point that lies behind that segment. */
  #nearnessToJoint(segment: number, x: number, y: number): number {
    const at = 4 * segment + 2;
    const wx = x - this.segments[at];
    const wy = y - this.segments[at + 1];
    const ux = this.segments[at + 4] - this.segments[at + 2];
    const uy = this.segments[at + 5] - this.segments[at + 3];
    const along = ux * wx + uy * wy;
    const doubt = 16 * EPSILON * (Math.abs(ux * wx) + Math.abs(uy * wy));
    if (along > doubt) return -1;
    const near = this.#compare(wx * wx + wy * wy, this.reach ** 2);
    return near < 0 || along < -doubt ? near : 0;
  }

  #hasJoint(segment: number): boolean {
    return this.#joined && 4 * segment + 4 < this.segments.length;
  }

  /** Limit minus a square, 0 where rounding leaves open which is greater. */
  #compare(square: number, limit: number): number {
    const left = limit - square;
    return Math.abs(left) > 16 * EPSILON * (limit + square) ? left : 0;
  }

  #isExactlyNear(segment: number, x: number, y: number): boolean {
    const [ax, ay, bx, by, , , cx, cy] = this.segments.subarray(4 * segment, 4 * segment + 8);
    if (isBeside(x, y, [ax, ay, bx, by], this.reach)) return true;
    return this.#hasJoint(segment) && isAtJoint(x, y, [ax, ay, bx, by, cx, cy], this.reach);
  }

  /** Whether a box lies in the rectangle of one segment, with certainty. */
  #covers(segment: number, [minX, minY, , maxX, maxY]: Float64Array): boolean {
    const [ax, ay, bx, by] = this.segments.subarray(4 * segment, 4 * segment + 4);
    const [ux, uy] = [bx - ax, by - ay];
    const length = Math.hypot(ux, uy);
    const safe = 1e-9 * (length + this.reach);
    for (const x of [minX, maxX]) {
      for (const y of [minY, maxY]) {
        const along = (ux * (x - ax) + uy * (y - ay)) / length;
        const across = (ux * (y - ay) - uy * (x - ax)) / length;
        if (!(along > safe && along < length - safe && Math.abs(across) < this.reach - safe)) return false;
      }
    }
    return true;
  }

  /** Distance between a segment and a box. */
  #gap(segment: number, [minX, minY, , maxX, maxY]: Float64Array): number {
    const [ax, ay, bx, by] = this.segments.subarray(4 * segment, 4 * segment + 4);
    const [ux, uy] = [bx - ax, by - ay];
    // Shares of the segment within the box's stretch of each axis: they overlap where it passes through.
    let [from, to] = [0, 1];
    for (const [start, step, least, greatest] of [
      [ax, ux, minX, maxX],
      [ay, uy, minY, maxY],
    ]) {
      if (step === 0) {
        if (start < least || start > greatest) to = -1;
        continue;
      }
      const [s, t] = [(least - start) / step, (greatest - start) / step];
      from = Math.max(from, Math.min(s, t));
      to = Math.min(to, Math.max(s, t));
    }
    if (from <= to) return 0;
    let gap = Number.POSITIVE_INFINITY;
    for (const [x, y] of [
      [ax, ay],
      [bx, by],
    ]) {
      gap = Math.min(gap, Math.hypot(Math.max(0, minX - x, x - maxX), Math.max(0, minY - y, y - maxY)));
    }
    const square = ux * ux + uy * uy;
    for (const x of [minX, maxX]) {
      for (const y of [minY, maxY]) {
        const share = Math.min(1, Math.max(0, (ux * (x - ax) + uy * (y - ay)) / square));
        gap = Math.min(gap, Math.hypot(x - ax - share * ux, y - ay - share * uy));
      }
    }
    return gap;
  }
}

/** Square of the length of a segment. */
function squareOf(segments: Segments, segment: number): number {
  const [ax, ay, bx, by] = segments.subarray(4 * segment, 4 * segment + 4);
  const [ux, uy] = [bx - ax, by - ay];
  return ux * ux + uy * uy;
}
