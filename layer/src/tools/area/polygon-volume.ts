import type { BoxRelation, QueryVolume } from "../../query/index.js";
import { sideOf } from "../exact/exact.js";

/** Bands of y that edges are sorted into, at most. */
const MOST_BANDS = 1024;

/**
 * All that stands on a polygon of the plane of the source coordinates, at any height: by the even-odd rule, so that rings
 * within rings are holes. Edges and corners belong to it; which side of an edge a point is on is decided without rounding.
 */
export class PolygonVolume implements QueryVolume {
  /** ax, ay, bx, by of each edge. */
  readonly #edges: Float64Array;
  readonly #minY: number;
  readonly #height: number;
  /** Where the edges of a band begin in {@link #members}. */
  readonly #begins: Uint32Array;
  readonly #members: Uint32Array;

  /**
   * @param rings x and y of the corners of each, source units; whether the first is repeated at the end does not matter
   * @throws RangeError where a ring has fewer than three corners, or a number is not finite
   */
  constructor(rings: readonly (readonly (readonly [number, number])[])[]) {
    const edges: number[] = [];
    for (const ring of rings) {
      if (!ring.flat().every(Number.isFinite)) throw new RangeError("a corner of the polygon is not finite");
      const before = edges.length;
      for (const [index, [ax, ay]] of ring.entries()) {
        const [bx, by] = ring[(index + 1) % ring.length];
        if (ax !== bx || ay !== by) edges.push(ax, ay, bx, by);
      }
      if (edges.length - before < 12)
        throw new RangeError("a ring of the polygon has fewer than three corners");
    }
    if (edges.length === 0) throw new RangeError("the polygon has no ring");
    this.#edges = Float64Array.from(edges);
    const ys = this.#edges.filter((_, index) => index % 2 === 1);
    this.#minY = ys.reduce((least, y) => Math.min(least, y), Number.POSITIVE_INFINITY);
    this.#height = ys.reduce((greatest, y) => Math.max(greatest, y), Number.NEGATIVE_INFINITY) - this.#minY;
    const bands = Math.min(MOST_BANDS, Math.max(1, edges.length >> 3));
    const begins = new Uint32Array(bands + 1);
    this.#begins = begins;
    this.#eachBand((band) => begins[band + 1]++);
    for (let band = 1; band <= bands; band++) begins[band] += begins[band - 1];
    this.#members = new Uint32Array(begins[bands]);
    const next = begins.slice();
    this.#eachBand((band, edge) => {
      this.#members[next[band]++] = edge;
    });
  }

  contains(x: number, y: number): boolean {
    if (!(y >= this.#minY && y <= this.#minY + this.#height)) return false;
    const band = this.#band(y);
    const edges = this.#edges;
    let inside = false;
    for (let at = this.#begins[band]; at < this.#begins[band + 1]; at++) {
      const from = 4 * this.#members[at];
      const ax = edges[from];
      const ay = edges[from + 1];
      const bx = edges[from + 2];
      const by = edges[from + 3];
      if (
        (x === ax && y === ay) ||
        (ay === y && by === y && x >= Math.min(ax, bx) && x <= Math.max(ax, bx))
      ) {
        return true;
      }
      if (ay > y === by > y) continue;
      const side = sideOf(x, y, ax, ay, bx, by);
      if (side === 0) return true;
      if (side > 0 === by > ay) inside = !inside;
    }
    return inside;
  }

  toBox([minX, minY, , maxX, maxY]: Float64Array): BoxRelation {
    const edges = this.#edges;
    for (let from = 0; from < edges.length; from += 4) {
      if (mayMeet(edges[from], edges[from + 1], edges[from + 2], edges[from + 3], minX, minY, maxX, maxY)) {
        return "crossing";
      }
    }
    // No edge comes near: what holds for one corner holds for the whole box.
    return this.contains(minX, minY) ? "in" : "out";
  }

  #band(y: number): number {
    const bands = this.#begins.length - 1;
    return Math.min(bands - 1, Math.max(0, Math.floor(((y - this.#minY) / this.#height) * bands) || 0));
  }

  /** Goes through the bands that each edge is in; bands of rounded numbers are in order all the same. */
  #eachBand(visit: (band: number, edge: number) => void): void {
    for (let edge = 0; 4 * edge < this.#edges.length; edge++) {
      const [ay, by] = [this.#edges[4 * edge + 1], this.#edges[4 * edge + 3]];
      for (let band = this.#band(Math.min(ay, by)); band <= this.#band(Math.max(ay, by)); band++) {
        visit(band, edge);
      }
    }
  }
}

/** False only where a segment and a box certainly have no point in common. */
function mayMeet(
  ax: number,
  ay: number,
  bx: number,
  by: number,
  minX: number,
  minY: number,
  maxX: number,
  maxY: number,
): boolean {
  if (Math.max(ax, bx) < minX || Math.min(ax, bx) > maxX) return false;
  if (Math.max(ay, by) < minY || Math.min(ay, by) > maxY) return false;
  const first = sideOf(minX, minY, ax, ay, bx, by);
  if (first === 0) return true;
  return (
    sideOf(maxX, minY, ax, ay, bx, by) !== first ||
    sideOf(maxX, maxY, ax, ay, bx, by) !== first ||
    sideOf(minX, maxY, ax, ay, bx, by) !== first
  );
}
