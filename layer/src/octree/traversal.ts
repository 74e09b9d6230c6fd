import type { NodeBounds, OctreeNode } from "./octree-node.js";
import { PriorityQueue } from "./priority-queue.js";
import { behindHorizon, outsideFrustum, projectedSize, type View } from "./view.js";

/** How far an octree is refined. */
export interface TraversalOptions {
  /** Pixels between neighbouring points above which the next level is wanted. */
  readonly maximumScreenSpaceError: number;
  /** Most points that a selection holds. */
  readonly pointBudget: number;
}

/** What one view wants of an octree. */
export interface Selection {
  /** Nodes with points, most important first, each after its parent. */
  readonly nodes: OctreeNode[];
  /** Nodes whose hierarchy page must be read before the view is complete, most important first. */
  readonly pages: OctreeNode[];
  /** Points of all {@link nodes} together. */
  readonly points: number;
  /** True where the point budget ended the refinement, not the screen-space error. */
  readonly limited: boolean;
}

/** Gives a node's bounds; called once per node that a view reaches. */
export type BoundsOf = (node: OctreeNode) => NodeBounds;

/**
 * Chooses the nodes that a view should show: from the root, always the one whose spacing is largest on the
 * screen next, until every spacing is below the screen-space error or the budget is spent. COPC octrees add:
 * a child's points are drawn with its parent's.
 */
export function selectNodes(
  root: OctreeNode,
  view: View,
  options: TraversalOptions,
  boundsOf: BoundsOf,
): Selection {
  const nodes: OctreeNode[] = [];
  const pages: OctreeNode[] = [];
  let points = 0;
  let limited = false;
  const queue = new PriorityQueue<OctreeNode>();
  const consider = (node: OctreeNode) => {
    node.bounds ??= boundsOf(node);
    if (outsideFrustum(view, node.bounds) || behindHorizon(view, node.bounds)) return;
    queue.push(node, priorityOf(view, node.bounds));
  };
  consider(root);
  for (let node = queue.pop(); node; node = queue.pop()) {
    if (node.state === "page" || node.state === "opening" || node.pageFailed) {
      pages.push(node);
      continue;
    }
    if (points + node.pointCount > options.pointBudget) {
      limited = true;
      break;
    }
    if (node.pointCount > 0) nodes.push(node);
    points += node.pointCount;
    const bounds = node.bounds!;
    if (!node.children || projectedSize(view, bounds, bounds.spacing) <= options.maximumScreenSpaceError) {
      continue;
    }
    for (const child of node.children) if (child) consider(child);
  }
  return { nodes, pages, points, limited };
}

/**
 * Importance of a node: its spacing in pixels, halved towards the edge of the picture and beyond, where the
 * eye does not rest. A node that the camera is in comes before all others, larger ones first.
 */
export function priorityOf(view: View, bounds: NodeBounds): number {
  const size = projectedSize(view, bounds, bounds.spacing);
  if (size === Number.POSITIVE_INFINITY) return 1e12 * (1 + bounds.spacing);
  const { position, direction } = view;
  const x = bounds.x - position[0];
  const y = bounds.y - position[1];
  const z = bounds.z - position[2];
  const length = Math.hypot(x, y, z);
  const cosine =
    length > bounds.radius ? (x * direction[0] + y * direction[1] + z * direction[2]) / length : 1;
  return size * (0.75 + 0.25 * cosine);
}
