import {
  type HierarchyEntry,
  type PointSource,
  type SourceBox,
  type SourceWarning,
  wrongBounds,
} from "../contract/point-source.js";
import type { LasHeader } from "../las/las-header.js";

/** Nodes that the header's bounds are held against. */
const MOST_NODES = 4096;

/** What is to be taken for the box of all points. */
export interface TrustedBox {
  readonly boundingBox: SourceBox;
  readonly warnings: readonly SourceWarning[];
}

/**
 * The bounds that the header declares, where every node with points has a part of its cell within them; else the cube
 * of the octree, since writers that take bounds over from other files, or leave them at 0, are known.
 * @param entries of the hierarchy's first page
 */
export function trustedBox(
  { min, max, scale }: Pick<LasHeader, "min" | "max" | "scale">,
  [x, y, z, edge]: PointSource["cube"],
  entries: Iterable<HierarchyEntry>,
): TrustedBox {
  const corner = [x, y, z];
  const meets = (depth: number, key: readonly number[]) =>
    corner.every((from, axis) => {
      const size = edge / 2 ** depth;
      const least = from + key[axis] * size;
      // Half of the last digit may be lost in the octree, in the bounds and in the points.
      const slack = 2 * scale[axis] + 1e-9 * edge;
      return least <= max[axis] + slack && least + size >= min[axis] - slack;
    });
  let holds = [...min, ...max].every(Number.isFinite) && min.every((least, axis) => least <= max[axis]);
  let seen = 0;
  for (const { depth, x, y, z, pointCount } of entries) {
    if (!holds || seen++ === MOST_NODES) break;
    if (pointCount > 0) holds = meets(depth, [x, y, z]);
  }
  if (holds) return { boundingBox: { min, max }, warnings: [] };
  const boundingBox: SourceBox = { min: [x, y, z], max: [x + edge, y + edge, z + edge] };
  return { boundingBox, warnings: [wrongBounds({ min, max })] };
}
