import { ancestorAt, keyName, octant, type VoxelKey } from "../../octree/voxel-key.js";
import { type DrawnDensity, drawnSpacing } from "./drawn-spacing.js";
import type { StyledNode } from "./facts.js";
import { OCTREE_INDEX, type UniformDeclaration, type UniformValues } from "./shader.js";

/** Texels in a row of the texture of the visible octree. */
const OCTREE_WIDTH = 256;

/** Deepest traversal below a point's own node, levels: bits of a coordinate in the cube. */
const BITS = 16;

/** Value of alpha at which a node's spacing is that of its level; a step is a sixteenth of a doubling. */
const CORRECTION_ZERO = 128;
const CORRECTION_STEPS = 16;

/**
 * From the point's own node down to the deepest drawn node around it (thesis, 4.3.3, fig. 4.16; beginning at the point's
 * own node is its future work). A texel: children drawn (red), texels to the first of them (green, blue),
 * correction of the spacing (alpha). Integers throughout: octants are bits of the place in the cube.
 */
const VISIBLE_LEVELS = `
/* x: levels from the point's own node down to the deepest drawn one; y: log2 of that one's spacing over its level's. */
vec2 visibleLevels(vec3 place) {
  uvec3 cell = uvec3(clamp(place, 0.0, 0.99999) * ${(2 ** BITS).toFixed(1)});
  int texel = ${OCTREE_INDEX};
  uvec4 node = uvec4(texelFetch(u_octree, ivec2(texel % ${OCTREE_WIDTH}, texel / ${OCTREE_WIDTH}), 0) * 255.0 + 0.5);
  int level = 0;
  while (level < ${BITS}) {
    uvec3 half3 = (cell >> uint(${BITS - 1} - level)) & 1u;
    uint child = half3.x | (half3.y << 1u) | (half3.z << 2u);
    if (((node.r >> child) & 1u) == 0u) break;
    uint before = node.r & ((1u << child) - 1u);
    before = before - ((before >> 1u) & 0x55u);
    before = (before & 0x33u) + ((before >> 2u) & 0x33u);
    before = (before + (before >> 4u)) & 0x0fu;
    texel += int((node.g | (node.b << 8u)) + before);
    node = uvec4(texelFetch(u_octree, ivec2(texel % ${OCTREE_WIDTH}, texel / ${OCTREE_WIDTH}), 0) * 255.0 + 0.5);
    level++;
  }
  return vec2(float(level), (float(node.a) - ${CORRECTION_ZERO.toFixed(1)}) / ${CORRECTION_STEPS.toFixed(1)});
}
`;

/** What all effects share that read the visible octree: the levels from the point's own node down to the deepest. */
export const OCTREE_READING = {
  uniforms: [
    { name: "u_octree", type: "sampler2D", scope: "texture" },
    { name: OCTREE_INDEX, type: "int", scope: "node" },
    { name: "u_toCube", type: "mat4", scope: "node" },
  ] satisfies UniformDeclaration[],
  functions: VISIBLE_LEVELS,
  locate: "vec2 visible = visibleLevels((u_toCube * vec4(stored, 1.0)).xyz);",
  values: ({ toCube }: StyledNode): UniformValues => ({ u_toCube: columnMajor(toCube) }),
} as const;

/** A 3 × 4 matrix, row by row, as 4 × 4, column by column. */
export function columnMajor(rows: ArrayLike<number>): number[] {
  return [
    ...[rows[0], rows[4], rows[8], 0],
    ...[rows[1], rows[5], rows[9], 0],
    ...[rows[2], rows[6], rows[10], 0],
    ...[rows[3], rows[7], rows[11], 1],
  ];
}

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
