import { type ColourStyle, colouringEffect, colourStatements } from "../declaration/colouring.js";
import { type Effect, showsColour } from "../declaration/effect.js";
import { GRADIENT_COLOUR } from "../declaration/gradients.js";
import { OCTREE_READING } from "../declaration/visible-octree.js";
import { type GradientStyle, styleGradient } from "./gradient.js";

/** The level of the deepest drawn node around each point as a colour (thesis, 4.1). */
export const levelOfDetail: Effect<{
  name: "levelOfDetail";
  reads: GradientStyle & ColourStyle;
  words: { color: "levelOfDetail" };
}> = {
  ...colouringEffect("levelOfDetail", "the level of detail"),
  options: {},
  words: { color: "levelOfDetail" },
  colours: { shows: (color, kind) => color === "levelOfDetail" && kind === undefined },
  nodeTexture: "octree",
  part(context) {
    if (!showsColour(context.pass)) return undefined;
    return {
      uniforms: [
        ...OCTREE_READING.uniforms,
        { name: "u_nodeLevel", type: "float", scope: "node" },
        { name: "u_levels", type: "vec2", scope: "layer" },
        { name: "u_gradient", type: "sampler2D", scope: "texture" },
      ],
      vertexFunctions: [OCTREE_READING.functions, GRADIENT_COLOUR],
      vertex: {
        locate: OCTREE_READING.locate,
        color: colourStatements(
          context,
          levelOfDetail,
          () => "gradientColor((u_nodeLevel + visible.x) * u_levels.x + u_levels.y)",
        ),
      },
    };
  },
  values({ style, facts }) {
    const [least, greatest] = style.range ?? [0, facts.levels[1]];
    const width = greatest > least ? greatest - least : 1;
    return { u_levels: [1 / width, -least / width] };
  },
  nodeValues: (_, node) => ({ ...OCTREE_READING.values(node), u_nodeLevel: node.level }),
  textures: ({ style }) => [styleGradient(style)],
};
