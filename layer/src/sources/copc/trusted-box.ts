import {
  type HierarchyEntry,
  type PointSource,
  type SourceBox,
  type SourceWarning,
  tooWideBounds,
  wrongBounds,
} from "../contract/point-source.js";
import type { LasHeader } from "../las/las-header.js";

/** Nodes that the header's bounds are held against. */
const MOST_NODES = 4096;

/** Share of the cube's edge by which declared bounds may leave it: writers round one or the other, and no lie is that small. */
const ROUNDING = 0.01;

/** What is to be taken for the box of all points. */
export interface TrustedBox {
  readonly boundingBox: SourceBox;
  readonly warnings: readonly SourceWarning[];
}

/**
 * The bounds that the header declares, where every node with points has a part of its cell within them; else the cube
 * of the octree, since writers that take bounds over from other files, or leave them at 0, are known. Where they reach
 * far beyond the cube, which holds all points, they are cut to it.
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
  let empty = true;
  for (const { depth, x, y, z, pointCount } of entries) {
    if (!holds || seen++ === MOST_NODES) break;
    if (pointCount !== 0) empty = false;
    if (pointCount > 0) holds = meets(depth, [x, y, z]);
  }
  const cube: SourceBox = { min: [x, y, z], max: [x + edge, y + edge, z + edge] };
  if (!holds) return { boundingBox: cube, warnings: [wrongBounds({ min, max })] };
  const beyond = corner.some((from, axis) => {
    const slack = 2 * scale[axis] + ROUNDING * edge;
    return min[axis] < from - slack || max[axis] > from + edge + slack;
  });
  // A cube without an extent says nothing, nor does one around no points.
  if (!beyond || empty || edge === 0) return { boundingBox: { min, max }, warnings: [] };
  const boundingBox = { min: within(min, cube), max: within(max, cube) };
  return { boundingBox, warnings: [tooWideBounds({ min, max })] };
}

function within([x, y, z]: SourceBox["min"], { min, max }: SourceBox): SourceBox["min"] {
  const cut = (value: number, axis: 0 | 1 | 2) => Math.min(Math.max(value, min[axis]), max[axis]);
  return [cut(x, 0), cut(y, 1), cut(z, 2)];
}
