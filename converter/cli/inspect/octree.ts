import type { HierarchyEntry, PointSource } from "@groma/layer/sources";

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
  /** Where their points come from. */
  readonly source: PointSource;
}

/** Entries of the hierarchy that are read at most. */
const MOST_ENTRIES = 1 << 21;

/** Reads the hierarchy page by page. @throws FormatError, SourceError */
export async function octree(source: PointSource): Promise<Octree> {
  const pages = [source.rootPage];
  const seen = new Set<string>();
  const nodes: HierarchyEntry[] = [];
  let left = MOST_ENTRIES;
  for (let page = pages.shift(); page !== undefined; page = pages.shift()) {
    for (const entry of await source.page(page)) {
      if (left-- === 0) return { ...counted(nodes, source), whole: false };
      const { depth, x, y, z, pointCount, address } = entry;
      if (pointCount > 0) nodes.push(entry);
      if (pointCount !== -1) continue;
      const name = [depth, x, y, z].join("-");
      // A damaged file may lead back to a page.
      if (!seen.has(name)) pages.push(address);
      seen.add(name);
    }
  }
  return { ...counted(nodes, source), whole: true };
}

function counted(nodes: HierarchyEntry[], source: PointSource): Omit<Octree, "whole"> {
  const levels: { level: number; nodes: number; points: number; spacing: number }[] = [];
  nodes.sort((a, b) => a.depth - b.depth);
  for (const { depth, pointCount } of nodes) {
    if (levels.at(-1)?.level !== depth) {
      levels.push({ level: depth, nodes: 0, points: 0, spacing: source.spacing / 2 ** depth });
    }
    const level = levels.at(-1)!;
    level.nodes++;
    level.points += pointCount;
  }
  return { levels, nodes, source };
}
