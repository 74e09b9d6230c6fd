import type { BoxRelation, QueryVolume } from "../../query/index.js";
import { isNear } from "../exact/exact.js";
import { SegmentGrid, type Segments } from "./segment-grid.js";

/** How distances along a line are counted. */
export interface Stationing {
  /** Lengths of the stretches between the vertices, in any unit. Default: in the plane. */
  readonly lengths?: readonly number[] | undefined;
  /** Chainage at the start of the line, in the same unit. Default: 0. */
  readonly start?: number | undefined;
}

/** Relative error of a float64 operation. */
const EPSILON = 2 ** -53;

/**
 * The strip along a polyline in the plane of the source coordinates: all points no farther than half the width from the
 * line. It ends squarely, where the line does; joints are mitred on the inner side (the border of two segments is the
 * bisector of their angle) and round on the outer one.
 *
 * Each point belongs to the part of the line that is nearest to it, the earlier one where two are as near: so no point is
 * taken twice or lost, whatever the angles are and wherever the line crosses itself. Whether a point lies in the strip is
 * decided without any rounding, on the float64 coordinates of the point and of the line.
 */
export class Corridor implements QueryVolume {
  /** x and y of the line's vertices, source units, as they were given. */
  readonly vertices: readonly (readonly [number, number])[];
  /** Chainage of each vertex. */
  readonly chainages: readonly number[];
  /** Half the width, source units. */
  readonly reach: number;
  readonly #segments: Segments;
  /** Chainage at the start of each segment, and at the end of the last. */
  readonly #stations: Float64Array;
  readonly #grid: SegmentGrid;

  /**
   * @param line x and y of each vertex, source units; vertices that repeat the one before are passed over
   * @param width of the whole strip, source units
   * @throws RangeError where the line has no length, or a number is not finite
   */
  constructor(
    line: readonly (readonly [number, number])[],
    width: number,
    { lengths, start = 0 }: Stationing = {},
  ) {
    if (!(width > 0 && Number.isFinite(width))) throw new RangeError(`the width cannot be ${width}`);
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
      stations.push(stations[stations.length - 1] + (lengths?.[index - 1] ?? Math.hypot(bx - ax, by - ay)));
      chainages.push(stations[stations.length - 1]);
    }
    if (ends.length === 0) throw new RangeError("the line has no length");
    this.vertices = line;
    this.chainages = chainages;
    this.reach = width / 2;
    this.#segments = Float64Array.from(ends);
    this.#stations = Float64Array.from(stations);
    this.#grid = new SegmentGrid(this.#segments, this.reach);
  }

  /** Length of the line, in the unit of its distances. */
  get length(): number {
    return this.#stations[this.#stations.length - 1] - this.#stations[0];
  }

  contains(x: number, y: number): boolean {
    const grid = this.#grid;
    grid.at(x, y);
    let doubt = false;
    for (let at = grid.begin; at < grid.end; at++) {
      const nearness = this.#nearness(grid.members[at], x, y);
      if (nearness > 0) return true;
      doubt ||= nearness === 0;
    }
    return doubt && this.#isExactlyNear(x, y);
  }

  toBox(box: Float64Array): BoxRelation {
    const [minX, minY, , maxX, maxY] = box;
    // What rounding may take from the differences of coordinates.
    const slack = 16 * EPSILON * Math.max(Math.abs(minX), Math.abs(maxX), Math.abs(minY), Math.abs(maxY));
    let met = false;
    for (let segment = 0; 4 * segment < this.#segments.length; segment++) {
      if (this.#covers(segment, box)) return "in";
      met ||= this.#gap(segment, box) <= this.reach * (1 + 16 * EPSILON) + slack;
    }
    return met ? "crossing" : "out";
  }

  /**
   * Finds the part of the line that a point of the strip belongs to.
   * @param out receives chainage and offset
   * @returns the number of the segment; -1 for a point that lies beyond the strip, whose numbers are NaN then
   */
  locate(x: number, y: number, out: Float64Array): number {
    const grid = this.#grid;
    grid.at(x, y);
    let [found, nearest] = [-1, Number.POSITIVE_INFINITY];
    out[0] = Number.NaN;
    out[1] = Number.NaN;
    for (let at = grid.begin; at < grid.end; at++) {
      const segment = grid.members[at];
      const from = 4 * segment;
      const ax = this.#segments[from];
      const ay = this.#segments[from + 1];
      const ux = this.#segments[from + 2] - ax;
      const uy = this.#segments[from + 3] - ay;
      const vx = x - ax;
      const vy = y - ay;
      const square = ux * ux + uy * uy;
      const share = (ux * vx + uy * vy) / square;
      if (this.#isCutOff(segment, share)) continue;
      const foot = Math.min(1, Math.max(0, share));
      // Each end is measured from itself, so that both segments of a joint find the same distance.
      const dx = foot === 1 ? x - this.#segments[from + 2] : vx - foot * ux;
      const dy = foot === 1 ? y - this.#segments[from + 3] : vy - foot * uy;
      const inside = foot > 0 && foot < 1;
      const distance = inside
        ? Math.abs(ux * vy - uy * vx) / Math.sqrt(square)
        : Math.sqrt(dx * dx + dy * dy);
      if (!(distance < nearest)) continue;
      [found, nearest] = [segment, distance];
      const length = this.#stations[segment + 1] - this.#stations[segment];
      out[0] = this.#stations[segment] + foot * length;
      out[1] = ux * vy - uy * vx < 0 ? -distance : distance;
    }
    return found;
  }

  /** Whether a foot lies before the squared start of the line, or behind its end, beyond what rounding may do. */
  #isCutOff(segment: number, share: number): boolean {
    if (segment === 0 && share < -1e-12) return true;
    return 4 * segment + 4 === this.#segments.length && share > 1 + 1e-12;
  }

  /** Above 0 where a point lies within reach of a segment, below where it does not, 0 where rounding leaves it open. */
  #nearness(segment: number, x: number, y: number): number {
    const from = 4 * segment;
    const ax = this.#segments[from];
    const ay = this.#segments[from + 1];
    const bx = this.#segments[from + 2];
    const by = this.#segments[from + 3];
    const ux = bx - ax;
    const uy = by - ay;
    const vx = x - ax;
    const vy = y - ay;
    const square = ux * ux + uy * uy;
    const along = ux * vx + uy * vy;
    // Each product has an error of some units in the last place of its factors; 16 is generous.
    const doubt = 16 * EPSILON * (Math.abs(ux * vx) + Math.abs(uy * vy) + square);
    if (Math.abs(along) <= doubt || Math.abs(along - square) <= doubt) return 0;
    if (along < 0) return segment === 0 ? -1 : this.#compare(vx * vx + vy * vy, this.reach ** 2);
    if (along > square) {
      const wx = x - bx;
      const wy = y - by;
      return from + 4 === this.#segments.length ? -1 : this.#compare(wx * wx + wy * wy, this.reach ** 2);
    }
    const across = ux * vy - uy * vx;
    const uncertain = 16 * EPSILON * (Math.abs(ux * vy) + Math.abs(uy * vx));
    const limit = this.reach * Math.sqrt(square);
    const left = limit - Math.abs(across);
    return Math.abs(left) > uncertain + 16 * EPSILON * limit ? left : 0;
  }

  /** Limit minus a square, 0 where rounding leaves open which is greater. */
  #compare(square: number, limit: number): number {
    const left = limit - square;
    return Math.abs(left) > 16 * EPSILON * (limit + square) ? left : 0;
  }

  #isExactlyNear(x: number, y: number): boolean {
    const { members, begin, end } = this.#grid;
    const last = this.#segments.length / 4 - 1;
    for (let at = begin; at < end; at++) {
      const segment = members[at];
      const [ax, ay, bx, by] = this.#segments.subarray(4 * segment, 4 * segment + 4);
      const flat = { start: segment === 0, end: segment === last };
      if (isNear(x, y, [ax, ay, bx, by], this.reach, flat)) return true;
    }
    return false;
  }

  /** Whether a box lies in the rectangle of one segment, with certainty. */
  #covers(segment: number, [minX, minY, , maxX, maxY]: Float64Array): boolean {
    const [ax, ay, bx, by] = this.#segments.subarray(4 * segment, 4 * segment + 4);
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
    const [ax, ay, bx, by] = this.#segments.subarray(4 * segment, 4 * segment + 4);
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
