import { colourStatements, LEAST_SHARE, shareOf } from "../colouring.js";
import type { Effect } from "../effect.js";
import { showsColour } from "../part.js";

/** The level of the deepest drawn node around each point as a colour (thesis, 4.1). */
export const levelOfDetail: Effect = {
  name: "levelOfDetail",
  unit: "share",
  threshold: LEAST_SHARE,
  source: "share of a point's colour (thesis, 4.1)",
  wish: (scene) =>
    shareOf(scene, "level") > 0
      ? { kind: "asked", why: "the style shows the level of detail" }
      : { kind: "off", why: "the style does not show the level of detail" },
  magnitude: (scene) => shareOf(scene, "level"),
  part({ plan, pass }) {
    if (!showsColour(pass)) return undefined;
    return {
      uniforms: [
        { name: "u_octree", type: "sampler2D", scope: "texture" },
        { name: "u_octreeIndex", type: "int", scope: "node" },
        { name: "u_toCube", type: "mat4", scope: "node" },
        { name: "u_nodeLevel", type: "float", scope: "node" },
        { name: "u_levels", type: "vec2", scope: "layer" },
        { name: "u_gradient", type: "sampler2D", scope: "texture" },
      ],
      vertexFunctions: "#include <visibleOctree>\n#include <gradient>",
      vertex: {
        locate: "vec2 visible = visibleLevels((u_toCube * vec4(a_position, 1.0)).xyz);",
        color: colourStatements(
          plan,
          "level",
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
};
