import type { PieceGroup } from "./parity.js";
import { type NodePlan, toPlan } from "./plan-of-node.js";
import type { Ring } from "./rings.js";
import { pointIn, type Vector } from "./vectors.js";
import type { ClipNode } from "./volume.js";

/** An edge in the plan of a node: from (ax, ay) to (bx, by), metres. */
export type PlanEdge = readonly [ax: number, ay: number, bx: number, by: number];

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
  [ax, ay, bx, by]: PlanEdge,
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
export function edgesForRays(pieces: readonly PlanEdge[], rectangle: NodePlan["rectangle"]): PlanEdge[] {
  const [west, south, , north] = rectangle;
  const edges: PlanEdge[] = [];
  for (const piece of pieces) {
    const edge = cutOff(piece, rectangle);
    if (!edge) continue;
    edges.push(edge);
    for (const [x, y] of [edge.slice(0, 2), edge.slice(2)]) {
      const comesIn = x === west && Math.min(piece[0], piece[2]) < west;
      if (comesIn) edges.push([west, y, west, 2 * north - south]);
    }
  }
  return edges;
}

/**
 * The part of an edge in a rectangle (Y.-D. Liang, B. Barsky, 1984); undefined where there is none. Ends that lie inside
 * stay as they are, to the last bit, so that neighbouring edges meet; an end on the western side has exactly its x.
 */
function cutOff(
  [ax, ay, bx, by]: PlanEdge,
  [west, south, east, north]: NodePlan["rectangle"],
): PlanEdge | undefined {
  const [dx, dy] = [bx - ax, by - ay];
  let [from, to] = [0, 1];
  let [fromWest, toWest] = [false, false];
  const sides = [
    [-dx, ax - west],
    [dx, east - ax],
    [-dy, ay - south],
    [dy, north - ay],
  ] as const;
  for (const [index, [along, room]] of sides.entries()) {
    if (along === 0) {
      if (room < 0) return undefined;
    } else if (along < 0 && room / along > from) {
      from = room / along;
      fromWest = index === 0;
    } else if (along > 0 && room / along < to) {
      to = room / along;
      toWest = index === 0;
    }
  }
  if (from > to) return undefined;
  const x = (share: number, atWest: boolean) => (atWest ? west : ax + share * dx);
  return [
    ...(from === 0 ? ([ax, ay] as const) : ([x(from, fromWest), ay + from * dy] as const)),
    ...(to === 1 ? ([bx, by] as const) : ([x(to, toWest), ay + to * dy] as const)),
  ];
}

/** Whether a ray to the west, and the way from its end to the south-western corner, meets an odd number of edges. */
export function oddWayTo(edges: readonly PlanEdge[], x: number, y: number): boolean {
  let odd = false;
  for (const [ax, ay, bx, by] of edges) {
    if (ay > y === by > y) continue;
    const side = (x - ax) * (by - ay) - (y - ay) * (bx - ax);
    if (side > 0 === by > ay) odd = !odd;
  }
  return odd;
}

/** Of a grid over a rectangle, the place farthest from all edges: there, inside and outside are sure. */
export function farFromEdges(
  edges: readonly PlanEdge[],
  [west, south, east, north]: NodePlan["rectangle"],
): readonly [number, number] {
  let best: readonly [number, number] = [(west + east) / 2, (south + north) / 2];
  if (edges.length === 0) return best;
  let farthest = -1;
  const steps = 7;
  for (let row = 1; row < steps; row++) {
    for (let column = 1; column < steps; column++) {
      const x = west + ((east - west) * column) / steps;
      const y = south + ((north - south) * row) / steps;
      let nearest = Number.POSITIVE_INFINITY;
      for (const [ax, ay, bx, by] of edges) {
        nearest = Math.min(nearest, squaredDistance(ax, ay, bx, by, x, y));
      }
      if (nearest > farthest) [farthest, best] = [nearest, [x, y]];
    }
  }
  return best;
}

/** Square of the distance of a place from an edge. */
function squaredDistance(ax: number, ay: number, bx: number, by: number, x: number, y: number): number {
  const [dx, dy] = [bx - ax, by - ay];
  const squared = dx * dx + dy * dy;
  const along = squared > 0 ? Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / squared, 0), 1) : 0;
  return (ax + along * dx - x) ** 2 + (ay + along * dy - y) ** 2;
}

/**
 * Chains of edges with those vertices left out that lie within a tolerance of the line between the others (D. Douglas,
 * T. Peucker, 1973): a large node need not follow every kilometre of a long edge.
 */
export function simplify(edges: readonly PlanEdge[], tolerance: number): PlanEdge[] {
  const simple: PlanEdge[] = [];
  for (let from = 0; from < edges.length; ) {
    let to = from + 1;
    while (to < edges.length && edges[to][0] === edges[to - 1][2] && edges[to][1] === edges[to - 1][3]) to++;
    const chain = edges.slice(from, to);
    const points = [[chain[0][0], chain[0][1]] as const, ...chain.map((edge) => [edge[2], edge[3]] as const)];
    const kept = keptOf(points, tolerance);
    for (let i = 1; i < kept.length; i++) simple.push([...points[kept[i - 1]], ...points[kept[i]]]);
    from = to;
  }
  return simple;
}

function keptOf(points: readonly (readonly [number, number])[], tolerance: number): number[] {
  const kept = [0];
  const stack: (readonly [number, number])[] = [[0, points.length - 1]];
  for (let span = stack.pop(); span; span = stack.pop()) {
    const [from, to] = span;
    const [[ax, ay], [bx, by]] = [points[from], points[to]];
    let farthest = tolerance * tolerance;
    let split = -1;
    for (let i = from + 1; i < to; i++) {
      const distance = squaredDistance(ax, ay, bx, by, points[i][0], points[i][1]);
      if (distance > farthest) [farthest, split] = [distance, i];
    }
    if (split < 0) kept.push(to);
    else stack.push([split, to], [from, split]);
  }
  return kept;
}
