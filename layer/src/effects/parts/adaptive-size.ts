import type { Effect } from "../effect.js";

/** Points as wide as the deepest drawn node around each is dense (thesis, 4.3.3). */
export const adaptiveSize: Effect = {
  name: "adaptiveSize",
  unit: "px",
  threshold: 1,
  source:
    "what widths differ by, factor · s (1 − d / D): s px between the points that lie widest apart, d and D m the least and greatest distance on the ground (thesis, eq. 4.4)",
  wish: ({ style }) =>
    style.size === "adaptive"
      ? { kind: "asked", why: "the style asks for adaptive sizes, and densities differ" }
      : { kind: "off", why: `the style asks for ${style.size} sizes` },
  magnitude({ style, facts }) {
    const { spacings, groundSpacings, pixelRatio } = facts;
    const width = Math.min(style.spacingFactor * spacings[1], style.maximumSize * pixelRatio);
    const [least, greatest] = groundSpacings;
    return greatest > 0 ? width * (1 - least / greatest) : 0;
  },
  part: () => ({
    uniforms: [
      { name: "u_octree", type: "sampler2D", scope: "texture" },
      { name: "u_octreeIndex", type: "int", scope: "node" },
      { name: "u_toCube", type: "mat4", scope: "node" },
      { name: "u_nodeSize", type: "float", scope: "node" },
      { name: "u_sizeLimits", type: "vec2", scope: "layer" },
    ],
    vertexFunctions: "#include <visibleOctree>\n#include <pixelsPerMetre>",
    vertex: {
      locate: "vec2 visible = visibleLevels((u_toCube * vec4(a_position, 1.0)).xyz);",
      measure: "float scale = pixelsPerMetre(gl_Position.w);",
      size:
        "float width = u_nodeSize * exp2(visible.y - visible.x) * scale;\n" +
        "width = clamp(width, u_sizeLimits.x * $pixelRatio, u_sizeLimits.y * $pixelRatio);\n" +
        "gl_PointSize = width;",
    },
  }),
  values: ({ style }) => ({ u_sizeLimits: [style.minimumSize, style.maximumSize] }),
};
