import type { Places, RingIndex } from "./ring-index.js";
import type { Tin } from "./tin.js";

/** Volumes between a surface and a base, all from 0 on. */
export interface CutAndFill {
  /** Above the base, cubic metres. */
  readonly cut: number;
  /** Below it. */
  readonly fill: number;
  /**
   * Part of the ring that the points cover, square metres: where the surface goes straight across a gap, ten times as wide as
   * most of its triangles are, it covers nothing.
   */
  readonly covered: number;
}

/**
 * The prisms between a surface of triangles and the level 0, within a ring: exact for that surface. Triangles that the
 * level cuts are split along it, triangles that the ring cuts are clipped (Sutherland and Hodgman, 1974).
 * @param differences surface of heights above the base
 */
export function prismsOf(differences: Tin, index: RingIndex): CutAndFill {
  const { triangles, xy, z } = differences;
  const gap = gapIn(differences, index);
  let [cut, fill, covered] = [0, 0, 0];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [triangles[t], triangles[t + 1], triangles[t + 2]];
    const [ax, ay, bx, by] = [xy[2 * a], xy[2 * a + 1], xy[2 * b], xy[2 * b + 1]];
    const [cx, cy] = [xy[2 * c], xy[2 * c + 1]];
    const relation = relationOf(index, xy, a, b, c);
    if (relation === "out") continue;
    let area: number;
    let above: number;
    let total: number;
    if (relation === "in") {
      area = Math.abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2;
      total = (area * (z[a] + z[b] + z[c])) / 3;
      above = area * aboveOf(z[a], z[b], z[c]);
    } else {
      const part = clipped(index.places, [ax, ay, z[a], bx, by, z[b], cx, cy, z[c]]);
      area = part.area;
      total = part.volume;
      above = part.above;
    }
    if (longestEdge(xy, a, b, c) <= gap) covered += area;
    cut += above;
    fill += above - total;
  }
  return { cut: Math.max(0, cut), fill: Math.max(0, fill), covered };
}

/** Triangles whose edges are looked at for the usual distance of points, and how many times that is a gap. */
const [SAMPLE, WIDER] = [2000, 10];

/** Length of an edge that leads across a gap, metres. */
function gapIn({ triangles, xy }: Tin, index: RingIndex): number {
  const count = triangles.length / 3;
  const step = Math.max(1, Math.floor(count / SAMPLE));
  const edges: number[] = [];
  for (let t = 0; t < count; t += step) {
    const [a, b, c] = triangles.subarray(3 * t, 3 * t + 3);
    if (relationOf(index, xy, a, b, c) !== "out") edges.push(longestEdge(xy, a, b, c));
  }
  edges.sort((one, other) => one - other);
  return edges.length > 0 ? WIDER * edges[edges.length >> 1] : Number.POSITIVE_INFINITY;
}

function longestEdge(xy: Float64Array, a: number, b: number, c: number): number {
  const square = (i: number, j: number) =>
    (xy[2 * i] - xy[2 * j]) ** 2 + (xy[2 * i + 1] - xy[2 * j + 1]) ** 2;
  return Math.sqrt(Math.max(square(a, b), square(b, c), square(c, a)));
}

/** Area of the part of a triangle that lies within a ring. @param a, b, c its corners among `xy` */
export function areaWithin(index: RingIndex, xy: Float64Array, a: number, b: number, c: number): number {
  const relation = relationOf(index, xy, a, b, c);
  if (relation === "out") return 0;
  const [ax, ay, bx, by] = [xy[2 * a], xy[2 * a + 1], xy[2 * b], xy[2 * b + 1]];
  const [cx, cy] = [xy[2 * c], xy[2 * c + 1]];
  if (relation === "in") return Math.abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2;
  return clipped(index.places, [ax, ay, 0, bx, by, 0, cx, cy, 0]).area;
}

function relationOf(index: RingIndex, xy: Float64Array, a: number, b: number, c: number) {
  return index.relation(
    Math.min(xy[2 * a], xy[2 * b], xy[2 * c]),
    Math.min(xy[2 * a + 1], xy[2 * b + 1], xy[2 * c + 1]),
    Math.max(xy[2 * a], xy[2 * b], xy[2 * c]),
    Math.max(xy[2 * a + 1], xy[2 * b + 1], xy[2 * c + 1]),
  );
}

/** Mean over a triangle of what is above 0, for heights of its corners. */
function aboveOf(a: number, b: number, c: number): number {
  const mean = (a + b + c) / 3;
  if (a >= 0 && b >= 0 && c >= 0) return mean;
  if (a <= 0 && b <= 0 && c <= 0) return 0;
  const positive = Number(a > 0) + Number(b > 0) + Number(c > 0);
  // The one corner on its own side of the level, and the other two.
  const lone = positive === 1 ? Math.max(a, b, c) : Math.min(a, b, c);
  const [p, q] = lone === a ? [b, c] : lone === b ? [a, c] : [a, b];
  const tip = ((lone * lone) / ((lone - p) * (lone - q))) * (lone / 3);
  return positive === 1 ? tip : mean - tip;
}

/** The part of a triangle in a ring: area, volume, and the volume above 0. @param t x, y, z of its corners */
function clipped(ring: Places, t: readonly number[]) {
  const [ax, ay, az, bx, by, bz, cx, cy, cz] = t;
  const twice = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
  if (twice === 0) return { area: 0, volume: 0, above: 0 };
  const heightAt = (x: number, y: number) => {
    const s = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / twice;
    const u = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / twice;
    return az + s * (bz - az) + u * (cz - az);
  };
  let part = ring;
  const sides = [
    [ax, ay, bx, by],
    [bx, by, cx, cy],
    [cx, cy, ax, ay],
  ] as const;
  const turn = Math.sign(twice);
  for (const [px, py, qx, qy] of sides) {
    part = half(part, (x, y) => turn * ((qx - px) * (y - py) - (qy - py) * (x - px)));
  }
  return {
    area: fan(part, () => 1),
    volume: fan(part, heightAt),
    above: fan(half(part, heightAt), heightAt),
  };
}

/** The part of a polygon where a linear function is not negative. */
function half(polygon: Places, of: (x: number, y: number) => number): Places {
  const kept: (readonly [number, number])[] = [];
  let here = polygon[polygon.length - 1];
  let v = here ? of(here[0], here[1]) : 0;
  for (const next of polygon) {
    const w = of(next[0], next[1]);
    if (v >= 0 !== w >= 0) {
      const share = v / (v - w);
      kept.push([here[0] + share * (next[0] - here[0]), here[1] + share * (next[1] - here[1])]);
    }
    if (w >= 0) kept.push(next);
    [here, v] = [next, w];
  }
  return kept;
}

/** Integral of a linear function over a polygon, counter-clockwise. */
function fan(polygon: Places, of: (x: number, y: number) => number): number {
  let sum = 0;
  for (let i = 2; i < polygon.length; i++) {
    const [[ax, ay], [bx, by], [cx, cy]] = [polygon[0], polygon[i - 1], polygon[i]];
    const area = ((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2;
    sum += (area * (of(ax, ay) + of(bx, by) + of(cx, cy))) / 3;
  }
  return sum;
}
