import { eastNorthUp, type Frame, pointIn, type Vector } from "@groma/georef";
import type { Vertex } from "../vertex/vertex.js";
import { coincident, crossing, tooFew } from "./refusals.js";

/** Where gnomonic pictures still serve: cosine of 80° from their middle. */
const FARTHEST = Math.cos((80 * Math.PI) / 180);

/**
 * A ring that bounds an area, without its closing vertex if it has one.
 * @throws MeasureError MEASURE_VERTICES with fewer than three vertices, MEASURE_CROSSING where two of its edges cross
 */
export function checkedRing(given: readonly Vertex[]): readonly Vertex[] {
  const first = given[0];
  const last = given[given.length - 1];
  const closed = given.length > 1 && first.ecef.every((value, axis) => value === last.ecef[axis]);
  const ring = closed && given.length > 3 ? given.slice(0, -1) : given;
  if (ring.length < 3) throw tooFew("a polygon", 3, ring.length);
  if (ring.every(({ ecef }) => ecef.every((value, axis) => value === ring[0].ecef[axis]))) {
    throw coincident("polygon", "all its vertices stand in one place");
  }
  const plan = gnomonic(ring);
  const edges = plan && crossingEdges(plan);
  if (edges) throw crossing(edges);
  return ring;
}

/** Frame at the middle of vertices, on the ground of the first: east, north, up, metres. */
export function frameOf(vertices: readonly Vertex[]): Frame {
  const [x0, y0, z0] = vertices[0].ecef;
  const sum = [0, 0, 0];
  for (const { ecef } of vertices) {
    sum[0] += ecef[0] - x0;
    sum[1] += ecef[1] - y0;
    sum[2] += ecef[2] - z0;
  }
  const count = vertices.length;
  return eastNorthUp([x0 + sum[0] / count, y0 + sum[1] / count, z0 + sum[2] / count]);
}

/** The vertices in a frame: x, y, z of each in turn, metres. */
export function inFrame(vertices: readonly Vertex[], frame: Frame): Float64Array {
  return Float64Array.from(vertices.flatMap(({ ecef: [x, y, z] }): Vector => pointIn(frame, x, y, z)));
}

/**
 * x, y of each vertex seen from the centre of the earth, on the plane that touches below their middle: great ellipses are
 * straight there, and geodesics nearly. Undefined for rings that reach too far around the earth.
 */
function gnomonic(ring: readonly Vertex[]): Float64Array | undefined {
  const sum = [0, 0, 0];
  for (const { ecef } of ring) for (let axis = 0; axis < 3; axis++) sum[axis] += ecef[axis];
  const { rotation: r } = eastNorthUp(sum);
  const size = Math.hypot(...ring[0].ecef);
  // Differences to the first vertex keep the digits that a small ring needs.
  const [x0, y0, z0] = ring[0].ecef;
  const axis = (at: number, x: number, y: number, z: number) => r[at] * x + r[at + 1] * y + r[at + 2] * z;
  const plan = new Float64Array(2 * ring.length);
  const [e0, n0, u0] = [axis(0, x0, y0, z0), axis(3, x0, y0, z0), axis(6, x0, y0, z0)];
  for (const [i, { ecef }] of ring.entries()) {
    const [x, y, z] = [ecef[0] - x0, ecef[1] - y0, ecef[2] - z0];
    const u = u0 + axis(6, x, y, z);
    if (u < FARTHEST * size) return undefined;
    const [e, n, du] = [axis(0, x, y, z), axis(3, x, y, z), u - u0];
    plan[2 * i] = ((e * u0 - e0 * du) / (u * u0)) * size;
    plan[2 * i + 1] = ((n * u0 - n0 * du) / (u * u0)) * size;
  }
  return plan;
}

/**
 * Two edges of a ring in the plane that cross or lie on each other, by their first vertices; undefined where none do.
 * Neighbours may touch in the vertex that they share.
 */
export function crossingEdges(plan: ArrayLike<number>): readonly [number, number] | undefined {
  const count = plan.length / 2;
  const at = (i: number): readonly [number, number] => [plan[2 * (i % count)], plan[2 * (i % count) + 1]];
  for (let i = 0; i < count; i++) {
    const [a, b] = [at(i), at(i + 1)];
    for (let j = i + 2; j < count; j++) {
      if (i === 0 && j === count - 1) continue;
      if (cross(a, b, at(j), at(j + 1))) return [i, j];
    }
  }
  return undefined;
}

type Point = readonly [number, number];

/** Whether two segments have a point in common that is inside of one of them at least. */
function cross(a: Point, b: Point, c: Point, d: Point): boolean {
  const apart = (axis: 0 | 1) =>
    Math.max(a[axis], b[axis]) < Math.min(c[axis], d[axis]) ||
    Math.max(c[axis], d[axis]) < Math.min(a[axis], b[axis]);
  if (apart(0) || apart(1)) return false;
  const [c1, d1] = [side(a, b, c), side(a, b, d)];
  const [a1, b1] = [side(c, d, a), side(c, d, b)];
  // What only touches is no crossing: vertices picked twice, or on an edge, still bound an area.
  return c1 * d1 < 0 && a1 * b1 < 0;
}

/** Positive where c lies left of the line from a to b. */
function side(a: Point, b: Point, c: Point): number {
  return Math.sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}
