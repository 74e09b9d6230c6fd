import type { VoxelKey } from "../../octree/voxel-key.js";

/** What of a node is drawn, where it is the deepest that is. */
export interface DrawnDensity {
  readonly key: VoxelKey;
  /** Points that it has. */
  readonly points: number;
  /** Of these, drawn. */
  readonly count: number;
  /** Whether the data set has no children of it, so that all points left over are in it, however many or few. */
  readonly leaf: boolean;
  /** Distance of points that its level stands for, metres on the ground. */
  readonly spacing: number;
  /** Least and greatest position of its points in its frame: min x, y, z, max x, y, z, metres. */
  readonly box: ArrayLike<number>;
}

/**
 * Distance between the points that are drawn where a node is the deepest of them, metres on the ground.
 *
 * Down to a level of spacing s there is 1/s² per area of a surface, and 1/(4s²) down to the one above. An inner node of
 * which a share is drawn brings as much of the rest; what the traversal counts by is the same (`octree/share.ts`). A
 * leaf holds what was left, which may be sparser than its level (thesis, 4.3.3, fig. 4.17) or denser (fig. 4.18; chapter
 * 7, 4): its points lie on the two longer sides of their box.
 */
export function drawnSpacing({ key, points, count, leaf, spacing, box }: DrawnDensity): number {
  const x = box[3] - box[0];
  const y = box[4] - box[1];
  const z = box[5] - box[2];
  const longest = Math.max(x, y, z);
  const middle = Math.max(Math.min(x, y), Math.min(Math.max(x, y), z));
  const area = leaf ? footprint(longest, middle, spacing) : undefined;
  return spacingOf(key.depth, points, count, spacing, area);
}

/**
 * The same in numbers, for what is asked of many nodes in each frame.
 * @param depth level of the node
 * @param area {@link footprint} of a leaf, square metres; undefined of other nodes
 */
export function spacingOf(
  depth: number,
  points: number,
  count: number,
  spacing: number,
  area: number | undefined,
): number {
  const above = depth > 0 ? 1 / (4 * spacing * spacing) : 0;
  const full = 1 / (spacing * spacing);
  const own = area === undefined ? (full - above) * (points > 0 ? count / points : 1) : count / area;
  const density = above + own;
  return density > 0 ? 1 / Math.sqrt(density) : spacing;
}

/** The two longer sides of a box, each at least `least` long, multiplied: square metres. */
export function footprint(longest: number, middle: number, least: number): number {
  return Math.max(longest, least) * Math.max(middle, least);
}
