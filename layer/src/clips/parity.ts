import { cross, difference, dot, unit, type Vector } from "@groma/georef";
import type { Ring } from "./rings.js";
import { STRIDE, type Steps } from "./steps.js";

/** Pieces that share a bounding sphere. */
const GROUP = 32;

/** Some pieces of a ring in turn, and the sphere around them, ECEF, metres. */
export interface PieceGroup {
  readonly from: number;
  readonly to: number;
  readonly centre: Vector;
  readonly radius: number;
}

/** Groups of the pieces of a ring; piece i runs from vertex i to the next. */
export function* groupsOf({ count, feet }: Ring): Steps<PieceGroup[]> {
  const groups: PieceGroup[] = [];
  for (let from = 0; from < count; from += GROUP) {
    const to = Math.min(from + GROUP, count);
    const sum = [0, 0, 0];
    for (let i = from; i <= to; i++) {
      for (let axis = 0; axis < 3; axis++) sum[axis] += feet[3 * (i % count) + axis];
    }
    const centre = sum.map((part) => part / (to - from + 1)) as [number, number, number];
    let radius = 0;
    for (let i = from; i <= to; i++) {
      const at = 3 * (i % count);
      radius = Math.max(
        radius,
        Math.hypot(feet[at] - centre[0], feet[at + 1] - centre[1], feet[at + 2] - centre[2]),
      );
    }
    groups.push({ from, to, centre, radius });
    yield;
  }
  return groups;
}

/** Whether a place on the ellipsoid is inside a ring. */
export type InsideRing = (foot: ArrayLike<number>) => boolean;

/** Distance of the place that is surely outside from the earth's centre, metres: that of the ground, roughly. */
const RADIUS = 6.4e6;

/**
 * Inside of a ring on the ellipsoid by the even-odd rule: pieces are arcs of planes through the earth's centre, and which
 * side a place lies on is the sign of a triple product of differences, right to 1e-9 m on the ground, at poles and
 * antimeridian as anywhere. A place is joined to one that is surely outside, 90° from the ring's middle, and the pieces on
 * the way are counted. Inside is the side away from the antipode of the middle.
 * @param middle of its corners, unit vector; no vertex lies 90° from it or farther
 */
export function* insideTest(ring: Ring, groups: readonly PieceGroup[], middle: Vector): Steps<InsideRing> {
  const { count, feet } = ring;
  const at = (i: number) => feet.subarray(3 * (i % count), 3 * (i % count) + 3);
  let least = 1;
  for (let i = 0; i < count; i++) {
    least = Math.min(least, dot(middle, unit(at(i))));
    if (i % STRIDE === STRIDE - 1) yield;
  }
  const outside = perpendicular(middle).map((part) => RADIUS * part) as unknown as Vector;
  return (foot) => {
    // Beyond the farthest vertex; arcs of a kilometre bulge out by next to nothing.
    if (dot(middle, unit(foot)) < least - 1e-6) return false;
    const way = cross(foot, outside);
    const length = Math.hypot(...way);
    const side = (a: ArrayLike<number>) => dot(way, difference(a, foot)) >= 0;
    let inside = false;
    for (const { from, to, centre, radius } of groups) {
      if (Math.abs(dot(way, centre)) > (radius + 1) * length) continue;
      for (let i = from; i < to; i++) {
        const [a, b] = [at(i), at(i + 1)];
        if (side(a) !== side(b) && meets(foot, outside, a, b)) inside = !inside;
      }
    }
    return inside;
  };
}

/** Whether the arc from p to q meets that from a to b, where a and b lie on two sides of it or of its prolongation. */
function meets(p: ArrayLike<number>, q: Vector, a: ArrayLike<number>, b: ArrayLike<number>): boolean {
  const plane = cross(a, difference(b, a));
  const [ofP, ofQ] = [dot(plane, difference(p, a)), dot(plane, q)];
  if (ofP >= 0 === ofQ >= 0) return false;
  const meeting = [0, 1, 2].map((axis) => p[axis] * Math.abs(ofQ) + q[axis] * Math.abs(ofP));
  return dot(meeting, a) > 0;
}

function perpendicular(to: Vector): Vector {
  const axis: Vector = Math.abs(to[2]) < 0.7 ? [0, 0, 1] : [1, 0, 0];
  return unit(cross(to, axis));
}
