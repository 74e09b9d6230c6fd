import type { Effect } from "../declaration/effect.js";
import { limitedWidth, PIXELS_PER_METRE, type SizeStyle } from "../declaration/points.js";
import { OCTREE_READING } from "../declaration/visible-octree.js";
import type { SpacedSizeStyle } from "./attenuated-size.js";

/** Points as wide as the deepest drawn node around each is dense (thesis, 4.3.3). */
export const adaptiveSize: Effect<{
  name: "adaptiveSize";
  reads: SizeStyle & SpacedSizeStyle;
  words: { size: "adaptive" };
}> = {
  name: "adaptiveSize",
  group: "sizes",
  words: { size: "adaptive" },
  options: {},
  nodeTexture: "octree",
  unit: "px",
  threshold: 1,
  source:
    "what widths differ by, factor · s (1 − d / D): s px between the points that lie widest apart, d and D m the least and greatest distance on the ground (thesis, eq. 4.4)",
  widths: {
    widest: (scene) => limitedWidth(scene.style.spacingFactor * scene.facts.spacings[1], scene),
    overlap: (width, { style }) => Math.max(0, width * (1 - 1 / style.spacingFactor)),
    limit: ({ maximumSize }) => maximumSize,
  },
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
      ...OCTREE_READING.uniforms,
      { name: "u_nodeSize", type: "float", scope: "node" },
      { name: "u_sizeLimits", type: "vec2", scope: "layer" },
    ],
    vertexFunctions: [OCTREE_READING.functions, PIXELS_PER_METRE.functions],
    vertex: {
      locate: OCTREE_READING.locate,
      measure: PIXELS_PER_METRE.measure,
      size:
        "float width = u_nodeSize * exp2(visible.y - visible.x) * scale;\n" +
        "width = clamp(width, u_sizeLimits.x * $pixelRatio, u_sizeLimits.y * $pixelRatio);\n" +
        "gl_PointSize = width;",
    },
  }),
  values: ({ style }) => ({ u_sizeLimits: [style.minimumSize, style.maximumSize] }),
  nodeValues: ({ style }, node) => ({
    ...OCTREE_READING.values(node),
    u_nodeSize: style.spacingFactor * node.spacing,
  }),
};
