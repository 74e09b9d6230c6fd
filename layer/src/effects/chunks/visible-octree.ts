/** Texels in a row of the texture of the visible octree. */
export const OCTREE_WIDTH = 256;

/** Deepest traversal below a point's own node, levels: bits of a coordinate in the cube. */
const BITS = 16;

/** Value of alpha at which a node's spacing is that of its level; a step is a sixteenth of a doubling. */
export const CORRECTION_ZERO = 128;
export const CORRECTION_STEPS = 16;

/**
 * From the point's own node down to the deepest drawn node around it (thesis, 4.3.3, fig. 4.16; beginning at the point's
 * own node is its future work). A texel: children drawn (red), texels to the first of them (green, blue),
 * correction of the spacing (alpha). Integers throughout: octants are bits of the place in the cube.
 */
export const VISIBLE_OCTREE = `
/* x: levels from the point's own node down to the deepest drawn one; y: log2 of that one's spacing over its level's. */
vec2 visibleLevels(vec3 place) {
  uvec3 cell = uvec3(clamp(place, 0.0, 0.99999) * ${(2 ** BITS).toFixed(1)});
  int texel = u_octreeIndex;
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
