import { type NodeBounds, NodeStore, type OctreeNode, type View, type VoxelKey } from "../octree/index.js";
import type { HierarchyEntry } from "../sources/contract/point-source.js";

/** Metres of the root's edge; the octree's corner is at the origin of ECEF. */
export const EDGE = 1024;

/** Levels below the root. */
const DEPTH = 5;

/** A flat octree of random shape in pages: nodes with and without points, some missing, some left out by the writer. */
export interface PagedOctree {
  /** Entries by the address of their page. */
  readonly pages: ReadonlyMap<unknown, readonly HierarchyEntry[]>;
  readonly points: number;
  readonly first: number;
}

/** Number from 0 to 1 that depends on what is given alone. */
function chance(seed: number, { depth, x, y }: VoxelKey, what: number): number {
  let hash = seed | 0;
  for (const part of [depth, x, y, what])
    hash = Math.imul(hash ^ (part + 0x9e3779b9), 0x85ebca6b) ^ (hash >>> 13);
  return ((hash ^ (hash >>> 16)) >>> 0) / 2 ** 32;
}

/** @param seed what its shape depends on */
export function pagedOctree(seed: number): PagedOctree {
  const pages = new Map<unknown, HierarchyEntry[]>();
  let points = 0;
  let next = 1000;
  const enterPage = (key: VoxelKey) => {
    const entries: HierarchyEntry[] = [];
    const address = next++;
    pages.set(address, entries);
    enter(key, entries, true);
    return address;
  };
  const enter = (key: VoxelKey, entries: HierarchyEntry[], first: boolean) => {
    if (!first && chance(seed, key, 0) < 0.25) {
      entries.push({ ...key, pointCount: -1, address: enterPage(key) });
      return;
    }
    const pointCount = chance(seed, key, 1) < 0.3 ? 0 : 50;
    points += pointCount;
    const written = first || pointCount > 0 || chance(seed, key, 2) < 0.5;
    if (written) entries.push({ ...key, pointCount, address: 10 });
    if (key.depth === DEPTH) return;
    for (let child = 0; child < 4; child++) {
      const x = 2 * key.x + (child & 1);
      const y = 2 * key.y + (child >> 1);
      const below = { depth: key.depth + 1, x, y, z: 0 };
      if (chance(seed, below, 3) > 0.2) enter(below, entries, false);
    }
  };
  const first = enterPage({ depth: 0, x: 0, y: 0, z: 0 });
  return { pages, points, first };
}

export function storeOf({ points, first }: PagedOctree): NodeStore {
  return new NodeStore("a.copc.laz", points, first);
}

export function boundsOf({ key }: OctreeNode): NodeBounds {
  const edge = EDGE / 2 ** key.depth;
  const middle = (index: number) => (index + 0.5) * edge;
  return { x: middle(key.x), y: middle(key.y), z: 0, radius: edge, spacing: edge / 8 };
}

/** Looks straight down on a square of the octree. @param half half its edge, metres */
export function viewAbove(x: number, y: number, half: number): View {
  const planes = [...[1, 0, 0, half - x, -1, 0, 0, half + x], ...[0, 1, 0, half - y, 0, -1, 0, half + y]];
  return {
    ...{ position: [x, y, 2 * half], direction: [0, 0, -1], planes, height: 100, horizon: false },
    projection: { kind: "perspective", fieldOfView: 1 },
  };
}
