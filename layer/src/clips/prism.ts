import { pointOf, type Vector } from "@groma/georef";
import { HAS_BOTTOM, HAS_TOP, PRISM, STARTS_INSIDE } from "./clip-roles.js";
import type { PieceGroup } from "./parity.js";
import {
  EDGE,
  edgesForRays,
  farFromEdges,
  groundRadius,
  nears,
  oddWayTo,
  piecesNear,
  simplify,
  type Tilt,
  tiltAt,
  vertexInPlan,
} from "./plan-edges.js";
import { fromPlan, type NodePlan, planOf } from "./plan-of-node.js";
import { footOf, type Ring } from "./rings.js";
import { STRIDE, type Steps } from "./steps.js";
import type { ClipNode, Relation, Volume, VolumeRecord } from "./volume.js";

/** Distance that a line through a node may leave out of a chain of edges, metres, where float32 is finer than that. */
const SIMPLIFICATION = 2e-5;

/** The lower or upper end of a prism over a node: height over the frame's origin, and its slope to east and north. */
export interface End {
  readonly height: number;
  readonly slope: readonly [number, number];
}

/** A ring with what its coordinates decide: what is inside, and where its ends are. */
export interface PrismShape {
  readonly ring: Ring;
  readonly groups: readonly PieceGroup[];
  /** Whether source z, not the normal, is the vertical. */
  readonly tilted: boolean;
  /** Metres by which the ring's feet may lie off the ellipsoid in height. */
  readonly slack: number;
  contains(ecef: ArrayLike<number>, source: ArrayLike<number>): boolean;
  /** Whether the vertical through a place is inside the ring. */
  inside(ecef: Vector): boolean;
  /** Least and greatest ellipsoidal height of each end, metres; undefined where there is none. */
  readonly bottom: readonly [number, number] | undefined;
  readonly top: readonly [number, number] | undefined;
  /** The ends over a node. */
  bottomOver(node: ClipNode, plan: NodePlan): End | undefined;
  topOver(node: ClipNode, plan: NodePlan): End | undefined;
}

/** What stands on the inside of a ring, between two heights where they are given. */
export function prism(shape: PrismShape): Volume {
  return {
    contains: shape.contains,
    toSphere: (x, y, z, radius) => sphereRelation(shape, x, y, z, radius),
    toNode: (node) => nodeRelation(shape, node),
  };
}

function sphereRelation(shape: PrismShape, x: number, y: number, z: number, radius: number): Relation {
  const { foot, height } = footOf(x, y, z);
  const { bottom, top } = shape;
  // The height over the ellipsoid changes by no more than the way.
  if ((bottom && height + radius < bottom[0]) || (top && height - radius > top[1])) return "out";
  const reach = groundRadius({ radius }) + shape.slack;
  const near = piecesNear(shape.groups, foot, reach).some((piece) => touches(shape.ring, piece, foot, reach));
  if (near) return "crossing";
  if (!shape.inside([x, y, z])) return "out";
  const whole =
    (!bottom || height - radius >= bottom[1] + shape.slack) &&
    (!top || height + radius <= top[0] - shape.slack);
  return whole ? "in" : "crossing";
}

/** Whether a piece comes nearer to a place than a reach; arcs sag by less than a metre. */
function touches({ feet, count }: Ring, piece: number, foot: Vector, reach: number): boolean {
  const [a, b] = [3 * piece, 3 * ((piece + 1) % count)];
  let squared = 0;
  let along = 0;
  for (let axis = 0; axis < 3; axis++) {
    const step = feet[b + axis] - feet[a + axis];
    squared += step * step;
    along += step * (foot[axis] - feet[a + axis]);
  }
  const share = squared > 0 ? Math.min(Math.max(along / squared, 0), 1) : 0;
  let distance = 0;
  for (let axis = 0; axis < 3; axis++) {
    distance += (feet[a + axis] + share * (feet[b + axis] - feet[a + axis]) - foot[axis]) ** 2;
  }
  return Math.sqrt(distance) <= reach + 1;
}

function* nodeRelation(shape: PrismShape, node: ClipNode): Steps<"in" | "out" | VolumeRecord> {
  const plan = planOf(node);
  const bottom = shape.bottomOver(node, plan);
  const top = shape.topOver(node, plan);
  const [west, south, east, north] = plan.rectangle;
  const [low, high] = plan.heights;
  const span = (end: End) =>
    Math.abs(end.slope[0]) * Math.max(Math.abs(west), Math.abs(east)) +
    Math.abs(end.slope[1]) * Math.max(Math.abs(south), Math.abs(north));
  if (bottom && high < bottom.height - span(bottom)) return "out";
  if (top && low > top.height + span(top)) return "out";
  const cutsBottom = bottom !== undefined && low < bottom.height + span(bottom);
  const cutsTop = top !== undefined && high > top.height - span(top);
  const { edges, tilt } = yield* edgesIn(shape, node, plan);
  const [x, y] = yield* farFromEdges(edges, plan.rectangle);
  const sure = shape.inside(pointOf(node.frame, ...fromPlan(plan, x, y, plan.middle)));
  if (edges.length === 0) {
    if (!sure) return "out";
    if (!cutsBottom && !cutsTop) return "in";
  }
  const startsInside = sure !== oddWayTo(edges, x, y);
  const curvature = (plan.inverseRadii[0] + plan.inverseRadii[1]) / 2;
  return {
    kind: PRISM,
    count: edges.length / EDGE,
    bits: (startsInside ? STARTS_INSIDE : 0) | (cutsBottom ? HAS_BOTTOM : 0) | (cutsTop ? HAS_TOP : 0),
    texels: [
      ...[...plan.inverseRadii, ...tilt],
      ...[plan.middle, bottom?.height ?? 0, top?.height ?? 0, curvature],
      ...[...(bottom?.slope ?? [0, 0]), ...(top?.slope ?? [0, 0])],
    ].concat(edges),
  };
}

/** The edges that cross a node, as rays need them, and the tilt that they are drawn with. */
function* edgesIn(
  { ring, groups, tilted, slack }: PrismShape,
  node: ClipNode,
  plan: NodePlan,
): Steps<{ readonly edges: number[]; readonly tilt: Tilt }> {
  const { foot } = footOf(...plan.centre);
  const near = piecesNear(groups, foot, groundRadius(plan) + slack);
  if (near.length === 0) return { edges: [], tilt: [0, 0] };
  const tilt: Tilt = tilted ? tiltAt(ring, near[0], node, plan) : [0, 0];
  const pieces: number[] = [];
  let last = -2;
  let end: readonly [number, number] = [0, 0];
  for (const [index, piece] of near.entries()) {
    const start = piece === last + 1 ? end : vertexInPlan(ring, piece, node, plan, tilt);
    end = vertexInPlan(ring, piece + 1, node, plan, tilt);
    last = piece;
    if (nears(...start, ...end, plan.rectangle)) pieces.push(...start, ...end);
    if (index % STRIDE === STRIDE - 1) yield;
  }
  const reach = Math.max(...plan.rectangle.map(Math.abs));
  const tolerance = Math.max(SIMPLIFICATION, reach * 2 ** -25);
  const simple = yield* simplify(pieces, tolerance);
  return { edges: yield* edgesForRays(simple, plan.rectangle), tilt };
}
