import { ancestorAt, keyName, octant, type VoxelKey } from "../octree/voxel-key.js";
import { CORRECTION_STEPS, CORRECTION_ZERO, OCTREE_WIDTH } from "./chunks/visible-octree.js";

/** A node as it is drawn. */
export interface VisibleNode {
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

/** The octree of the drawn nodes as a texture. */
export interface VisibleOctree {
  /** RGBA, 8 bits each, row by row; see the chunk `visibleOctree`. */
  readonly texture: Uint8Array;
  readonly width: number;
  readonly height: number;
  /** Texel of each node given, in their order. */
  readonly indices: Uint32Array;
}

/** Least and greatest correction of a spacing, log2. */
const CORRECTIONS = [-6, 2] as const;

/** Farthest first child that two bytes can point to. */
const FARTHEST_CHILD = 65535;

/**
 * Encodes the drawn nodes breadth first (thesis, 4.3.3, fig. 4.16): which children of a node are drawn, how far
 * the first of them lies, and how dense the node really is. Ancestors that are not drawn themselves hold the tree together.
 */
export function encodeVisibleOctree(nodes: readonly VisibleNode[]): VisibleOctree {
  const entries = new Map<string, Entry>();
  const enter = (key: VoxelKey): Entry => {
    const name = keyName(key);
    let entry = entries.get(name);
    if (!entry) {
      entry = { depth: key.depth, octant: octant(key), index: 0, children: [], correction: CORRECTION_ZERO };
      entries.set(name, entry);
      if (key.depth > 0) enter(ancestorAt(key, key.depth - 1)).children.push(entry);
    }
    return entry;
  };
  const drawn = nodes.map((node) => {
    const entry = enter(node.key);
    entry.correction = encodeCorrection(spacingCorrection(node));
    return entry;
  });
  const root = [...entries.values()].find(({ depth }) => depth === 0);
  const ordered: Entry[] = root ? [root] : [];
  for (let at = 0; at < ordered.length; at++) {
    ordered[at].index = at;
    ordered[at].children.sort((a, b) => a.octant - b.octant);
    ordered.push(...ordered[at].children);
  }
  const height = Math.max(1, Math.ceil(ordered.length / OCTREE_WIDTH));
  const texture = new Uint8Array(4 * OCTREE_WIDTH * height);
  for (const { index, children, correction } of ordered) {
    const offset = children.length > 0 ? children[0].index - index : 0;
    const mask = children.reduce((bits, child) => bits | (1 << child.octant), 0);
    // A tree so wide that two bytes do not reach is cut there: its points are drawn as those of the coarser level.
    texture.set(
      offset <= FARTHEST_CHILD ? [mask, offset & 255, offset >> 8, correction] : [0, 0, 0, correction],
      4 * index,
    );
  }
  return { texture, width: OCTREE_WIDTH, height, indices: Uint32Array.from(drawn, ({ index }) => index) };
}

interface Entry {
  readonly depth: number;
  readonly octant: number;
  index: number;
  readonly children: Entry[];
  correction: number;
}

/**
 * log2 of the distance between the points where a node is the deepest drawn, over the spacing of its level.
 *
 * An inner node is a sample of its level's spacing; of a surface's points, drawing one in n spreads them by √n. A leaf
 * holds what was left, which may be sparser than its level (thesis, 4.3.3, fig. 4.17) or denser (fig. 4.18; chapter 7, 4):
 * its points lie on the two longer sides of their box, N / A per area; its ancestors add what their levels stand for,
 * 1/s² · (1/4 + 1/16 + …) = 1/(3 s²) (1 − 4^−depth). Together they are 1/d² per area.
 */
export function spacingCorrection({ points, count, leaf, spacing, box, key }: VisibleNode): number {
  if (!leaf) return count > 0 ? 0.5 * Math.log2(points / count) : 0;
  const sides = [box[3] - box[0], box[4] - box[1], box[5] - box[2]].sort((a, b) => b - a);
  const area = Math.max(sides[0], spacing) * Math.max(sides[1], spacing);
  const above = (1 - 4 ** -key.depth) / (3 * spacing * spacing);
  const density = count / area + above;
  return density > 0 ? -0.5 * Math.log2(density * spacing * spacing) : 0;
}

function encodeCorrection(correction: number): number {
  const [least, greatest] = CORRECTIONS;
  return CORRECTION_ZERO + Math.round(CORRECTION_STEPS * Math.min(Math.max(correction, least), greatest));
}
