import { pointIn, type Vector } from "@groma/georef";
import type { PieceGroup } from "./parity.js";
import { type NodePlan, toPlan } from "./plan-of-node.js";
import type { Ring } from "./rings.js";
import { STRIDE, type Steps } from "./steps.js";
import type { ClipNode } from "./volume.js";

/** Edges in the plan of a node, one after the other: from (ax, ay) to (bx, by), metres. */
export type PlanEdges = readonly number[];

/** Numbers of an edge. */
export const EDGE = 4;

/** How the ring's verticals lean in the plan, metres per metre of z over the middle of the box. */
export type Tilt = readonly [number, number];

/** Ground around a node that its points' verticals reach, metres around the foot of its middle. */
export function groundRadius({ radius }: Pick<NodePlan, "radius">): number {
  return radius * (1.02 + radius / 3e6) + 1;
}

/** Vertices of a ring's pieces that may cross a node: indices of pieces, by their groups' spheres. */
export function piecesNear(groups: readonly PieceGroup[], foot: Vector, reach: number): number[] {
  const near: number[] = [];
  for (const { from, to, centre, radius } of groups) {
    const distance = Math.hypot(centre[0] - foot[0], centre[1] - foot[1], centre[2] - foot[2]);
    if (distance > radius + reach) continue;
    for (let piece = from; piece < to; piece++) near.push(piece);
  }
  return near;
}

/** Place of a ring's vertex in a node's plan. */
export function vertexInPlan(
  ring: Ring,
  vertex: number,
  { frame }: ClipNode,
  plan: NodePlan,
  [tiltX, tiltY]: Tilt,
): [number, number] {
  const at = 3 * (vertex % ring.count);
  const lift = plan.height + plan.middle;
  const { feet, ups } = ring;
  const [x, y, z] = pointIn(
    frame,
    feet[at] + lift * ups[at],
    feet[at + 1] + lift * ups[at + 1],
    feet[at + 2] + lift * ups[at + 2],
  );
  const [u, v] = toPlan(plan, x, y, z);
  return [u - (z - plan.middle) * tiltX, v - (z - plan.middle) * tiltY];
}

/** Where a line through two points of the ring leans to per metre of z: source z is not the normal everywhere. */
export function tiltAt(ring: Ring, vertex: number, { frame }: ClipNode, plan: NodePlan): Tilt {
  const at = 3 * (vertex % ring.count);
  const { feet, ups } = ring;
  const step = 100;
  const point = (lift: number) =>
    pointIn(
      frame,
      feet[at] + lift * ups[at],
      feet[at + 1] + lift * ups[at + 1],
      feet[at + 2] + lift * ups[at + 2],
    );
  const lift = plan.height + plan.middle;
  const [low, high] = [point(lift - step), point(lift + step)];
  const [a, b] = [toPlan(plan, ...low), toPlan(plan, ...high)];
  const rise = high[2] - low[2];
  return [(b[0] - a[0]) / rise, (b[1] - a[1]) / rise];
}

/** Whether an edge may come into a rectangle: whether its own does. */
export function nears(
  ax: number,
  ay: number,
  bx: number,
  by: number,
  [west, south, east, north]: NodePlan["rectangle"],
): boolean {
  return (
    Math.max(ax, bx) >= west &&
    Math.min(ax, bx) <= east &&
    Math.max(ay, by) >= south &&
    Math.min(ay, by) <= north
  );
}

/**
 * Edges in a plan as rays need them. Each is cut off at the rectangle, in float64, so that in float32 all of it is as fine
 * as the node is small. Where an edge comes in from the west, the western side is an edge from there to the north, for
 * the way along that side to the south-western corner.
 */
export function* edgesForRays(pieces: PlanEdges, rectangle: NodePlan["rectangle"]): Steps<number[]> {
  const [west, south, , north] = rectangle;
  const edges: number[] = [];
  for (let at = 0; at < pieces.length; at += EDGE) {
    const [ax, bx] = [pieces[at], pieces[at + 2]];
    const first = edges.length;
    if (!cutOff(edges, ax, pieces[at + 1], bx, pieces[at + 3], rectangle)) continue;
    const comesIn = Math.min(ax, bx) < west;
    for (const end of [first, first + 2]) {
      if (comesIn && edges[end] === west) edges.push(west, edges[end + 1], west, 2 * north - south);
    }
    if (at % (EDGE * STRIDE) === 0) yield;
  }
  return edges;
}

/**
 * Adds the part of an edge in a rectangle (Y.-D. Liang, B. Barsky, 1984); false where there is none. Ends that lie inside
 * stay as they are, to the last bit, so that neighbouring edges meet; an end on the western side has exactly its x.
 */
function cutOff(
  edges: number[],
  ax: number,
  ay: number,
  bx: number,
  by: number,
  [west, south, east, north]: NodePlan["rectangle"],
): boolean {
  const [dx, dy] = [bx - ax, by - ay];
  let [from, to] = [0, 1];
  let [fromWest, toWest] = [false, false];
  for (let side = 0; side < 4; side++) {
    const along = side === 0 ? -dx : side === 1 ? dx : side === 2 ? -dy : dy;
    const room = side === 0 ? ax - west : side === 1 ? east - ax : side === 2 ? ay - south : north - ay;
    if (along === 0) {
      if (room < 0) return false;
    } else if (along < 0 && room / along > from) {
      from = room / along;
      fromWest = side === 0;
    } else if (along > 0 && room / along < to) {
      to = room / along;
      toWest = side === 0;
    }
  }
  if (from > to) return false;
  if (from === 0) edges.push(ax, ay);
  else edges.push(fromWest ? west : ax + from * dx, ay + from * dy);
  if (to === 1) edges.push(bx, by);
  else edges.push(toWest ? west : ax + to * dx, ay + to * dy);
  return true;
}

/** Whether a ray to the west, and the way from its end to the south-western corner, meets an odd number of edges. */
export function oddWayTo(edges: PlanEdges, x: number, y: number): boolean {
  let odd = false;
  for (let at = 0; at < edges.length; at += EDGE) {
    const [ay, by] = [edges[at + 1], edges[at + 3]];
    if (ay > y === by > y) continue;
    const ax = edges[at];
    const side = (x - ax) * (by - ay) - (y - ay) * (edges[at + 2] - ax);
    if (side > 0 === by > ay) odd = !odd;
  }
  return odd;
}

/** Of a grid over a rectangle, the place farthest from all edges: there, inside and outside are sure. */
export function* farFromEdges(
  edges: PlanEdges,
  [west, south, east, north]: NodePlan["rectangle"],
): Steps<readonly [number, number]> {
  let best: readonly [number, number] = [(west + east) / 2, (south + north) / 2];
  if (edges.length === 0) return best;
  let farthest = -1;
  const steps = 7;
  for (let row = 1; row < steps; row++) {
    for (let column = 1; column < steps; column++) {
      const x = west + ((east - west) * column) / steps;
      const y = south + ((north - south) * row) / steps;
      let nearest = Number.POSITIVE_INFINITY;
      for (let at = 0; at < edges.length && nearest > farthest; at += EDGE) {
        const distance = squaredDistance(edges[at], edges[at + 1], edges[at + 2], edges[at + 3], x, y);
        if (distance < nearest) nearest = distance;
      }
      if (nearest > farthest) [farthest, best] = [nearest, [x, y]];
    }
    if (edges.length > EDGE * STRIDE) yield;
  }
  return best;
}

/** Square of the distance of a place from an edge. */
function squaredDistance(ax: number, ay: number, bx: number, by: number, x: number, y: number): number {
  const dx = bx - ax;
  const dy = by - ay;
  const squared = dx * dx + dy * dy;
  const along = squared > 0 ? Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / squared, 0), 1) : 0;
  return (ax + along * dx - x) ** 2 + (ay + along * dy - y) ** 2;
}

/**
 * Chains of edges with those vertices left out that lie within a tolerance of the line between the others (D. Douglas,
 * T. Peucker, 1973): a large node need not follow every kilometre of a long edge.
 */
export function* simplify(edges: PlanEdges, tolerance: number): Steps<number[]> {
  const simple: number[] = [];
  for (let from = 0; from < edges.length; ) {
    let to = from + EDGE;
    while (to < edges.length && edges[to] === edges[to - 2] && edges[to + 1] === edges[to - 1]) to += EDGE;
    const kept = yield* keptOf(edges, from, to - EDGE, tolerance);
    for (let i = 0; i < kept.length; i++) {
      const start = i === 0 ? from : kept[i - 1] + 2;
      simple.push(edges[start], edges[start + 1], edges[kept[i] + 2], edges[kept[i] + 3]);
    }
    from = to;
  }
  return simple;
}

/** Of a chain from an edge to another, those whose ends stay. */
function* keptOf(edges: PlanEdges, first: number, last: number, tolerance: number): Steps<number[]> {
  const kept: number[] = [];
  // Vertices by the edge that ends there; the first of all by the one before.
  const stack: number[] = [first - EDGE, last];
  while (stack.length > 0) {
    const to = stack.pop()!;
    const from = stack.pop()!;
    const start = from < first ? first : from + 2;
    let farthest = tolerance * tolerance;
    let split = -1;
    for (let at = from + EDGE; at < to; at += EDGE) {
      const distance = squaredDistance(
        edges[start],
        edges[start + 1],
        edges[to + 2],
        edges[to + 3],
        edges[at + 2],
        edges[at + 3],
      );
      if (distance > farthest) [farthest, split] = [distance, at];
    }
    if (split < 0) kept.push(to);
    else stack.push(split, to, from, split);
    if (to - from > EDGE * STRIDE) yield;
  }
  return kept;
}
