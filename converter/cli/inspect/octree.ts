import type { CopcFile, HierarchyEntry } from "@groma/layer/sources";

/** One level of the octree. */
export interface Level {
  readonly level: number;
  readonly nodes: number;
  readonly points: number;
  /** Least distance of points that the level is made for, source units. */
  readonly spacing: number;
}

/** The octree of a COPC file. */
export interface Octree {
  readonly levels: readonly Level[];
  /** False where the hierarchy is larger than what is read of it. */
  readonly whole: boolean;
  /** Nodes with points, the coarse ones first. */
  readonly nodes: readonly HierarchyEntry[];
}

/** Bytes of the hierarchy that are read at most: two million nodes. */
const MOST_BYTES = 1 << 26;

/** Reads the hierarchy page by page. @throws FormatError, SourceError */
export async function octree(copc: CopcFile): Promise<Octree> {
  const { readHierarchyPage } = await import("@groma/layer/sources");
  const pages = [copc.info.rootPage];
  const seen = new Set<number>();
  const nodes: HierarchyEntry[] = [];
  let bytes = 0;
  for (let page = pages.shift(); page; page = pages.shift()) {
    // A damaged file may lead back to a page.
    if (seen.has(page.offset)) continue;
    seen.add(page.offset);
    bytes += page.length;
    if (bytes > MOST_BYTES) return { ...counted(nodes, copc.info.spacing), whole: false };
    for (const entry of await readHierarchyPage(copc, page)) {
      if (entry.pointCount === -1) pages.push(entry.address);
      else if (entry.pointCount > 0) nodes.push(entry);
    }
  }
  return { ...counted(nodes, copc.info.spacing), whole: true };
}

function counted(nodes: HierarchyEntry[], spacing: number): Omit<Octree, "whole"> {
  const levels: { level: number; nodes: number; points: number; spacing: number }[] = [];
  nodes.sort((a, b) => a.depth - b.depth);
  for (const { depth, pointCount } of nodes) {
    if (levels.at(-1)?.level !== depth) {
      levels.push({ level: depth, nodes: 0, points: 0, spacing: spacing / 2 ** depth });
    }
    const level = levels.at(-1)!;
    level.nodes++;
    level.points += pointCount;
  }
  return { levels, nodes };
}
