import { PlacementError } from "@groma/georef";
import type { Place, SourceSpace } from "./volume.js";

/** Corner of a ring in source coordinates. */
export type Corner = readonly [number, number];

/**
 * A data set's map, carried on beyond its points: a file's own transformation ends with its bounding box, but the edges
 * of volumes do not. Outside, the map is linear from the nearest place inside.
 */
export function extendedPlace(space: SourceSpace): Place {
  const { min, max } = space.boundingBox;
  const inner = new Float64Array(3);
  const probe = new Float64Array(3);
  return (x, y, z, out) => {
    const cx = Math.min(Math.max(x, min[0]), max[0]);
    const cy = Math.min(Math.max(y, min[1]), max[1]);
    space.place(cx, cy, z, inner);
    out.set(inner);
    carryOn(x - cx, (step) => space.place(cx + step, cy, z, probe), max[0] - min[0], cx, inner, out);
    carryOn(y - cy, (step) => space.place(cx, cy + step, z, probe), max[1] - min[1], cy, inner, out);
    return out;
  };
}

/** Share of a coordinate over which a secant is taken at least: over less, the rounding of ECEF is carried on as well. */
const LEAST_SECANT = 1e-6;
/** Shorter secants for data sets without width, where the map ends with them: as far as transformations reach around them. */
const SHORTER = [1e-1, 1e-2, 1e-3];

/**
 * Adds how far a place moves along one axis, by the secant inwards over a thousandth of the data set. Where that is too
 * little, it goes beyond the other edge, as far as the map does.
 */
function carryOn(
  beyond: number,
  at: (step: number) => Float64Array,
  width: number,
  edge: number,
  from: Float64Array,
  out: Float64Array,
): void {
  if (beyond === 0) return;
  const least = LEAST_SECANT * Math.max(1, Math.abs(edge));
  const inwards = -Math.sign(beyond);
  const lengths =
    width >= least
      ? [Math.max(width / 1000, least)]
      : [least, width, ...SHORTER.map((share) => share * least)];
  for (const length of lengths) {
    if (length === 0) continue;
    const inside = orUndefined(at, inwards * length);
    if (!inside) continue;
    for (let axis = 0; axis < 3; axis++)
      out[axis] += ((inside[axis] - from[axis]) / (inwards * length)) * beyond;
    return;
  }
}

/** A place, where the map has it. */
function orUndefined(at: (step: number) => Float64Array, step: number): Float64Array | undefined {
  try {
    const place = at(step);
    return place.every(Number.isFinite) ? place : undefined;
  } catch (error) {
    if (error instanceof PlacementError) return undefined;
    throw error;
  }
}

/**
 * What of a ring lies over a data set: the ring cut off a little outside its bounding box (I. Sutherland, G. Hodgman,
 * "Reentrant polygon clipping", 1974). For points of the data set nothing changes.
 */
export function ringOver(corners: readonly Corner[], { boundingBox }: SourceSpace): readonly Corner[] {
  const { min, max } = boundingBox;
  // So far that no point of the data set is near the cut.
  const margin = 0.01 * Math.max(max[0] - min[0], max[1] - min[1]) + 1e-3 * Math.abs(max[2] - min[2]) + 1e-6;
  let ring = corners;
  for (const axis of [0, 1] as const) {
    ring = cutAt(ring, axis, min[axis] - margin, 1);
    ring = cutAt(ring, axis, max[axis] + margin, -1);
  }
  return ring;
}

function cutAt(ring: readonly Corner[], axis: 0 | 1, limit: number, sign: 1 | -1): readonly Corner[] {
  const kept: Corner[] = [];
  ring.forEach((corner, index) => {
    const next = ring[(index + 1) % ring.length];
    const here = sign * (corner[axis] - limit);
    const there = sign * (next[axis] - limit);
    if (here >= 0) kept.push(corner);
    if (here >= 0 === there >= 0) return;
    const share = here / (here - there);
    const other = corner[1 - axis] + share * (next[1 - axis] - corner[1 - axis]);
    kept.push(axis === 0 ? [limit, other] : [other, limit]);
  });
  return kept;
}

/** Whether a point lies inside a ring of the plane, by the even-odd rule, on differences to the point. */
export function insideRing(ring: readonly Corner[], x: number, y: number): boolean {
  let inside = false;
  for (let i = 0, j = ring.length - 1; i < ring.length; j = i++) {
    const [ax, ay] = [ring[j][0] - x, ring[j][1] - y];
    const [bx, by] = [ring[i][0] - x, ring[i][1] - y];
    if (ay > 0 === by > 0) continue;
    if (ax * (by - ay) - ay * (bx - ax) < 0 === by > ay) inside = !inside;
  }
  return inside;
}

/**
 * Source coordinates of a place by Newton's method, from a start near it.
 * @param ecef metres
 */
export function sourceOf(
  place: Place,
  ecef: ArrayLike<number>,
  start: readonly [number, number, number],
): [number, number, number] {
  const at: [number, number, number] = [...start];
  const here = new Float64Array(3);
  const there = new Float64Array(3);
  for (let round = 0; round < 12; round++) {
    place(...at, here);
    const rest = [0, 1, 2].map((axis) => ecef[axis] - here[axis]);
    if (Math.hypot(...rest) < 1e-6) break;
    const columns = [0, 1, 2].map((axis) => {
      const step = Math.max(1, Math.abs(at[axis])) * 1e-6;
      const moved: [number, number, number] = [...at];
      moved[axis] += step;
      place(...moved, there);
      return [0, 1, 2].map((row) => (there[row] - here[row]) / step);
    });
    const change = solve(columns, rest);
    for (let axis = 0; axis < 3; axis++) at[axis] += change[axis];
  }
  return at;
}

/** Cramer's rule for three unknowns, by columns. */
function solve([a, b, c]: number[][], right: number[]): number[] {
  const determinant = (p: number[], q: number[], r: number[]) =>
    p[0] * (q[1] * r[2] - q[2] * r[1]) +
    p[1] * (q[2] * r[0] - q[0] * r[2]) +
    p[2] * (q[0] * r[1] - q[1] * r[0]);
  const all = determinant(a, b, c);
  return [determinant(right, b, c) / all, determinant(a, right, c) / all, determinant(a, b, right) / all];
}
