import type { HierarchyPage, NodeBounds, OctreeNode } from "./octree-node.js";
import { PriorityQueue } from "./priority-queue.js";
import { type Demand, shareOf, thresholdFor } from "./share.js";
import { distanceToMiddle, horizonOf, outsideFrustum, pixelsPerMetre, type View } from "./view.js";

/** Gives a node's bounds; called once per node that a view reaches. */
export type BoundsOf = (node: OctreeNode) => NodeBounds;

/** What a demand is gathered by. */
export interface DemandOptions {
  readonly maximumScreenSpaceError: number;
  /** Points beyond which nothing needs to be gathered. */
  readonly limit: number;
  readonly prefix: boolean;
  readonly rejects: ((bounds: NodeBounds) => boolean) | undefined;
}

/** A demand with the nodes that it is of. */
export interface Gathered {
  readonly demand: Demand;
  readonly nodes: OctreeNode[];
  /** Distance between neighbouring points on the screen, pixels, by node. */
  readonly spacings: number[];
  /** Nodes whose hierarchy page must be read, most important first. */
  readonly pages: OctreeNode[];
  /** Pages that the traversal went through. */
  readonly open: HierarchyPage[];
  /** Nodes too small by little. */
  readonly fringe: OctreeNode[];
}

/** How much smaller than a node that is drawn one may be to be in the fringe. */
export const FRINGE = 0.9;

/** The list of gathered nodes grows by this factor before it is asked again what spacing the limit allows. */
const GROWTH = 1.25;

/** Relative width around a threshold in which nodes that are drawn whole or not at all are for the limit to choose. */
const AT_THRESHOLD = 1e-6;

/**
 * Goes through an octree from the root, always to the node next whose spacing is largest on the screen, until every
 * spacing is below the screen-space error or more points are found than the limit could ever let through.
 *
 * Importance is the spacing in pixels, halved towards the edge of the picture and beyond, where the eye does not rest;
 * never more than that of the node above. A node with nothing above it counts by the distance of its points where they are
 * fewer than its level has room for. A node that the camera is in comes before all others, larger ones first.
 */
export function gather(root: OctreeNode, view: View, options: DemandOptions, boundsOf: BoundsOf): Gathered {
  const { maximumScreenSpaceError: error, limit, prefix, rejects } = options;
  const nodes: OctreeNode[] = [];
  const spacings: number[] = [];
  const pages: OctreeNode[] = [];
  const open: HierarchyPage[] = [];
  const fringe: OctreeNode[] = [];
  const demand: Demand = { sizes: [], caps: [], pixels: [], base: [], prefix };
  const metre = pixelsPerMetre(view);
  const orthographic = view.projection.kind === "orthographic";
  const behindHorizon = horizonOf(view);
  // What is gathered already passes the limit down to this spacing, and more only widens it. Nothing below it shows but
  // of nodes that have none above them.
  let floor = 0;
  let bases = 0;
  reached.clear();
  queue.clear();
  const consider = (node: OctreeNode, above: number, base: boolean) => {
    node.bounds ??= boundsOf(node);
    const { bounds } = node;
    const length = distanceToMiddle(view, bounds);
    const distance = orthographic ? 1 : Math.max(0, length - bounds.radius);
    const pixels = (bounds.spacing * metre) / distance;
    if (!base && 2 * pixels <= FRINGE * error) return;
    if (!base && 2 * pixels < floor) return;
    if (outsideFrustum(view, bounds) || behindHorizon(bounds) || rejects?.(bounds)) return;
    const own = distance === 0 ? AROUND * bounds.spacing : pixels * weightOf(view, bounds, length);
    const weighted = own < above ? own : above;
    if (!base && 2 * weighted < floor) return;
    if (base) bases++;
    const sparse = base ? sparseness(node.pointCount, bounds) : 1;
    queue.push(reached.add(node, pixels, weighted, base, sparse), sparse * weighted);
  };
  consider(root, Number.POSITIVE_INFINITY, true);
  let points = 0;
  let check = 0;
  for (let index = queue.pop(); index !== undefined; index = queue.pop()) {
    const node = reached.nodes[index];
    const pixels = reached.pixels[index];
    const weighted = reached.weighted[index];
    const base = reached.base[index] === 1;
    const sparse = reached.sparse[index];
    if (base) bases--;
    else if (2 * weighted < floor) {
      // Whatever is still to come is less important than this node.
      if (bases === 0) break;
      continue;
    }
    const { state, pointCount, children, page } = node;
    const drawn = base || 2 * pixels > error;
    if (!drawn) {
      fringe.push(node);
      continue;
    }
    if (state === "page" || state === "opening" || node.pageFailed) {
      pages.push(node);
      continue;
    }
    // A page is entered by its root and in no other way.
    if (page?.root === node) open.push(page);
    if (pointCount > 0) {
      nodes.push(node);
      spacings.push(pixels);
      demand.sizes.push(pointCount);
      demand.caps.push(prefix ? shareOf(sparse * pixels, error, base) : 1);
      demand.pixels.push(sparse * weighted);
      demand.base.push(base);
      points += pointCount;
      if (points > limit && nodes.length >= check) {
        floor = thresholdFor([demand], limit, floor) * (1 - AT_THRESHOLD);
        check = Math.ceil(GROWTH * nodes.length);
      }
    }
    const bare = base && pointCount === 0;
    if (!children || !(bare || pixels > FRINGE * error)) continue;
    for (const child of children) if (child) consider(child, weighted, bare);
  }
  reached.clear();
  return { demand, nodes, spacings, pages, open, fringe };
}

/** What a traversal came to, column by column, since an object for each of thousands of nodes in every frame is dear. */
class ReachedNodes {
  nodes: OctreeNode[] = [];
  pixels = new Float64Array(1024);
  weighted = new Float64Array(1024);
  sparse = new Float64Array(1024);
  base = new Uint8Array(1024);

  /** @returns the index of the node */
  add(node: OctreeNode, pixels: number, weighted: number, base: boolean, sparse: number): number {
    const index = this.nodes.length;
    if (index === this.base.length) this.#grow();
    this.pixels[index] = pixels;
    this.weighted[index] = weighted;
    this.base[index] = base ? 1 : 0;
    this.sparse[index] = sparse;
    this.nodes.push(node);
    return index;
  }

  /** Forgets all of them, so that none is kept alive. */
  clear(): void {
    this.nodes = [];
  }

  #grow(): void {
    const longer = <Numbers extends Float64Array | Uint8Array>(numbers: Numbers, into: Numbers) => {
      into.set(numbers);
      return into;
    };
    const length = 2 * this.base.length;
    this.pixels = longer(this.pixels, new Float64Array(length));
    this.weighted = longer(this.weighted, new Float64Array(length));
    this.sparse = longer(this.sparse, new Float64Array(length));
    this.base = longer(this.base, new Uint8Array(length));
  }
}

/** Of the traversal that is under way: one serves all, since none begins before another has ended. */
const reached = new ReachedNodes();
const queue = new PriorityQueue();

/** Pixels per metre of spacing at which nodes around the camera rank. */
const AROUND = 1e12;

/**
 * How many times as wide apart as its level says a node's points are where nothing is above it, at least 1: n points on a
 * square of diagonal 2r lie √(2/n) r apart, and closer only where they leave a part of it empty. With its level alone, which
 * stands for a surface without gaps, most of a hundred points far apart would be left out although each shows by itself.
 */
function sparseness(points: number, { radius, spacing }: NodeBounds): number {
  return points > 0 ? Math.max(1, (Math.sqrt(2 / points) * radius) / spacing) : 1;
}

/**
 * 1 for a node in the middle of the picture, 0.75 beside the camera, 0.5 behind it.
 * @param length distance from the camera to the middle of its sphere, metres
 */
function weightOf({ position, direction }: View, bounds: NodeBounds, length: number): number {
  const x = bounds.x - position[0];
  const y = bounds.y - position[1];
  const z = bounds.z - position[2];
  if (length <= bounds.radius) return 1;
  return 0.75 + (0.25 * (x * direction[0] + y * direction[1] + z * direction[2])) / length;
}
