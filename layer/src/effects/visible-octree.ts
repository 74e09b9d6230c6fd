import { ancestorAt, keyName, octant, type VoxelKey } from "../octree/voxel-key.js";
import { CORRECTION_STEPS, CORRECTION_ZERO, OCTREE_WIDTH } from "./chunks/visible-octree.js";
import { type DrawnDensity, drawnSpacing } from "./drawn-spacing.js";

/** A node as it is drawn. */
export type VisibleNode = DrawnDensity;

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
    entry.correction = encodeCorrection(Math.log2(drawnSpacing(node) / node.spacing));
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

function encodeCorrection(correction: number): number {
  const [least, greatest] = CORRECTIONS;
  return CORRECTION_ZERO + Math.round(CORRECTION_STEPS * Math.min(Math.max(correction, least), greatest));
}
