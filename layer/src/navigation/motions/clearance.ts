import { difference, dot, type Vector } from "@groma/georef";
import { beside } from "./turning.js";

/** Parts at most in which a way is gone; each is half of the clearance, so that no wall is jumped over. */
const PARTS = 128;
/** Clearances that a way goes at most. */
export const FARTHEST = PARTS / 2;
/** Times that a place is pushed out of the way of one obstacle after the other, as in a corner. */
const PUSHES = 3;

/**
 * Where a way leads that keeps a clearance from obstacles: it slides along them. One that begins too near to an obstacle
 * comes no nearer, and is not pushed away. It goes 64 clearances at most.
 * @param points obstacles: x, y, z of each
 */
export function keepClear(from: Vector, to: Vector, clearance: number, points: readonly number[]): Vector {
  const way = difference(to, from);
  const length = Math.hypot(...way);
  if (length === 0) return to;
  const parts = Math.ceil((2 * length) / clearance);
  let at = from;
  for (let part = 0; part < Math.min(PARTS, parts); part++) {
    at = aside(at, beside(at, 1 / parts, way), clearance, points);
  }
  return at;
}

function aside(from: Vector, to: Vector, clearance: number, points: readonly number[]): Vector {
  let at = to;
  for (let push = 0; push <= PUSHES; push++) {
    const obstacle = nearest(at, clearance, points);
    if (!obstacle) return at;
    const away = difference(at, obstacle);
    const distance = Math.hypot(...away);
    const before = difference(from, obstacle);
    const kept = Math.min(clearance, Math.hypot(...before));
    // What has been pushed away from it lies within the radius still, by rounding.
    if (distance >= kept * (1 - 1e-6) && dot(away, before) >= 0) return at;
    // From too near, a part of the way may lead past it.
    if (push === PUSHES || distance === 0 || dot(away, before) < 0) break;
    at = beside(obstacle, kept / distance, away);
  }
  return from;
}

/** The nearest obstacle within a radius of a place; undefined where there is none. */
function nearest([x, y, z]: Vector, radius: number, points: readonly number[]): Vector | undefined {
  let least = radius * radius;
  let found = -1;
  for (let at = 0; at + 2 < points.length; at += 3) {
    const [dx, dy, dz] = [points[at] - x, points[at + 1] - y, points[at + 2] - z];
    const square = dx * dx + dy * dy + dz * dz;
    if (square < least) [least, found] = [square, at];
  }
  return found < 0 ? undefined : [points[found], points[found + 1], points[found + 2]];
}
