import { type BoundsOf, FRINGE, gather } from "./demand.js";
import type { HierarchyPage, NodeBounds, OctreeNode } from "./octree-node.js";
import { countsAt, thresholdFor } from "./share.js";
import type { Grant, SharedBudget } from "./shared-budget.js";
import type { View } from "./view.js";

/** How far an octree is refined. */
export interface TraversalOptions {
  /** Pixels between neighbouring points above which the next level is wanted. */
  readonly maximumScreenSpaceError: number;
  /** Most points that a selection holds. */
  readonly pointBudget: number;
  /** Points that several clouds of a scene share; holds beside {@link pointBudget}. Default: none are shared. */
  readonly budget?: SharedBudget | undefined;
  /** Whether a node may be drawn in part, so that density changes without popping. Default: true. */
  readonly prefix?: boolean | undefined;
  /** Says of a node that nothing of it will be drawn; neither it nor anything below it is then asked for. */
  readonly rejects?: ((bounds: NodeBounds) => boolean) | undefined;
}

/**
 * Share of a node's points from which it is worth its bytes, all of which have to come. Left out below it, the points on the
 * screen are up to √(1 + 3 · share) times as far apart as asked for, a sixth more ({@link shareOf}); where the node is here
 * anyway, they are drawn from the first one on.
 */
const LEAST_SHARE = 1 / 8;

/** What one view wants of an octree. */
export interface Selection {
  /** Nodes with points, most important first, each after its parent. */
  readonly nodes: OctreeNode[];
  /** How many points of each of {@link nodes} to draw, from the first in drawing order; at least 1. */
  readonly counts: number[];
  /** Whether so much of each of {@link nodes} is to be drawn that it is worth to be asked for. */
  readonly worth: boolean[];
  /** Distance between neighbouring points of each of {@link nodes} on the screen, pixels; Infinity around the camera. */
  readonly spacings: number[];
  /** Nodes whose hierarchy page must be read before the view is complete, most important first. */
  readonly pages: OctreeNode[];
  /** Hierarchy pages that it rests on. */
  readonly open: HierarchyPage[];
  /** Nodes a little too small to be drawn: not to be asked for, nor to be stopped where they are on their way. */
  readonly fringe: OctreeNode[];
  /** Sum of {@link counts}. */
  readonly points: number;
  /** True where the point budget ended the refinement, not the screen-space error. */
  readonly limited: boolean;
}

/**
 * Chooses the nodes that a view should show, and how many points of each: the whole picture to one distance between
 * points, the screen-space error, or the least that the budget allows. COPC octrees add: a child's points are drawn
 * with its parent's.
 * @param viewer stands for the view in a shared budget; the same object in each call
 */
export function selectNodes(
  root: OctreeNode,
  view: View,
  options: TraversalOptions,
  boundsOf: BoundsOf,
  viewer: object = root,
): Selection {
  const { maximumScreenSpaceError, pointBudget, budget, prefix = true, rejects } = options;
  const limit = Math.min(pointBudget, budget?.points ?? Number.POSITIVE_INFINITY);
  const gathered = gather(root, view, { maximumScreenSpaceError, limit, prefix, rejects }, boundsOf);
  const { demand, pages, open, fringe } = gathered;
  const grant: Grant = budget ? budget.grant(viewer, demand, pointBudget) : alone();
  const selection = {
    ...{ nodes: [] as OctreeNode[], counts: [] as number[] },
    ...{ worth: [] as boolean[], spacings: [] as number[] },
  };
  let points = 0;
  for (let index = 0; index < grant.counts.length; index++) {
    const count = grant.counts[index];
    const node = gathered.nodes[index];
    if (count === 0) {
      if (2 * demand.pixels[index] > FRINGE * grant.threshold) fringe.push(node);
      continue;
    }
    points += count;
    selection.nodes.push(node);
    selection.counts.push(count);
    selection.worth.push(demand.base[index] || count >= LEAST_SHARE * node.pointCount);
    selection.spacings.push(gathered.spacings[index]);
  }
  return { ...selection, pages, open, fringe, points, limited: grant.threshold > 0 };

  function alone(): Grant {
    const threshold = thresholdFor([demand], limit);
    return { counts: countsAt(demand, threshold, limit), threshold };
  }
}
