import {
  ecefVertex,
  MEASUREMENT_KINDS,
  type Measurement,
  sourceVertex,
  type Vertex,
} from "../measure/index.js";
import { wayOf } from "./course.js";
import type { Draft } from "./history.js";
import type { ScreenPoint, ViewAdapter } from "./view-adapter.js";

/** Pixels around a vertex or an edge in which it is taken. */
const SNAP = 9;
/** Halvings by which the place on an edge is found: to a thousandth of its length and finer than a pixel. */
const STEPS = 24;

/** What a new vertex may snap to. */
export interface Snaps {
  readonly vertices: readonly Vertex[];
  readonly edges: readonly (readonly [Vertex, Vertex])[];
}

/** All that is drawn, but what a vertex that is on its way belongs to. @param held that vertex */
export function snapsOf(
  measurements: readonly Measurement[],
  draft: Draft | undefined,
  held?: Vertex | undefined,
): Snaps {
  const vertices = [...(draft?.vertices ?? []), ...measurements.flatMap((one) => one.vertices)];
  return {
    vertices: vertices.filter((one) => one !== held),
    edges: measurements.flatMap(edgesOf).filter((edge) => held === undefined || !edge.includes(held)),
  };
}

/** The edges of a figure as they are drawn. */
function edgesOf({ kind, vertices }: Measurement): (readonly [Vertex, Vertex])[] {
  const { shape } = MEASUREMENT_KINDS[kind];
  if (shape === "points") return [];
  const way = wayOf(shape === "ring" ? [...vertices, vertices[0]] : vertices);
  return way.slice(1).map((vertex, i) => [way[i], vertex] as const);
}

/** The vertex nearest to a place of the view, if it is near enough. */
export function nearestVertex(view: ViewAdapter, at: ScreenPoint, { vertices }: Snaps): Vertex | undefined {
  let nearest: Vertex | undefined;
  let least = SNAP;
  for (const vertex of vertices) {
    const apart = away(view, vertex, at);
    if (apart <= least) [nearest, least] = [vertex, apart];
  }
  return nearest;
}

/**
 * The place on the nearest edge, if it is near enough: a vertex that is no record. Between two vertices of one data set it
 * is one of its places.
 */
export function nearestOnEdge(view: ViewAdapter, at: ScreenPoint, { edges }: Snaps): Vertex | undefined {
  let nearest: Vertex | undefined;
  let least = SNAP;
  for (const [a, b] of edges) {
    const from = view.project(a, at);
    const to = view.project(b, from);
    // As far as both are seen, an edge is drawn straight.
    if (!from || !to || toSegment(at, from, to) > least) continue;
    const vertex = between(a, b, shareOf(view, a, b, at));
    const apart = away(view, vertex, at);
    if (apart <= least) [nearest, least] = [vertex, apart];
  }
  return nearest;
}

/** Share of the way from a to b whose place is seen nearest; perspective puts the middle elsewhere. */
function shareOf(view: ViewAdapter, a: Vertex, b: Vertex, at: ScreenPoint): number {
  let [low, high] = [0, 1];
  for (let step = 0; step < STEPS; step++) {
    const [one, other] = [low + (high - low) * 0.382, low + (high - low) * 0.618];
    if (away(view, spatial(a, b, one), at) <= away(view, spatial(a, b, other), at)) high = other;
    else low = one;
  }
  return (low + high) / 2;
}

function between(a: Vertex, b: Vertex, share: number): Vertex {
  const { cloud, source } = a;
  if (!cloud || cloud !== b.cloud || !source || !b.source) return spatial(a, b, share);
  const to = b.source;
  const part = (axis: 0 | 1 | 2) => source[axis] + share * (to[axis] - source[axis]);
  return sourceVertex(cloud, [part(0), part(1), part(2)]);
}

function spatial(a: Vertex, b: Vertex, share: number): Vertex {
  return ecefVertex(a.ecef.map((value, axis) => value + share * (b.ecef[axis] - value)));
}

function away(view: ViewAdapter, vertex: Vertex, at: ScreenPoint): number {
  const place = view.project(vertex, at);
  return place ? Math.hypot(place.x - at.x, place.y - at.y) : Number.POSITIVE_INFINITY;
}

function toSegment(at: ScreenPoint, from: ScreenPoint, to: ScreenPoint): number {
  const [x, y] = [to.x - from.x, to.y - from.y];
  const square = x * x + y * y;
  const along = square > 0 ? ((at.x - from.x) * x + (at.y - from.y) * y) / square : 0;
  const share = Math.min(1, Math.max(0, along));
  return Math.hypot(from.x + share * x - at.x, from.y + share * y - at.y);
}
