import { colourStatements, LEAST_SHARE, shareOf } from "../colouring.js";
import type { Effect } from "../effect.js";
import { showsColour } from "../part.js";

/** Scalar attributes through a gradient (thesis, 4.1). */
export const gradient: Effect = {
  name: "gradient",
  unit: "share",
  threshold: LEAST_SHARE,
  source: "share of a point's colour (thesis, 4.1)",
  wish: (scene) =>
    shareOf(scene, "scalar") > 0
      ? { kind: "asked", why: "the style shows a scalar attribute" }
      : { kind: "off", why: "the style shows no scalar attribute" },
  magnitude: (scene) => shareOf(scene, "scalar"),
  part({ plan, pass, attribute }) {
    if (!showsColour(pass)) return undefined;
    const scalars = plan.colourings
      .map(({ kind, column }, index) => ({ kind, column: column!, index }))
      .filter(({ kind }) => kind === "scalar");
    const toned = plan.active.has("tone");
    return {
      attributes: scalars.map(({ column }) => ({ column, components: 1, normalized: false })),
      uniforms: [
        ...scalars.map(({ index }) => ({
          name: `u_value${index}`,
          type: "vec2" as const,
          scope: "node" as const,
        })),
        { name: "u_gradient", type: "sampler2D", scope: "texture" },
      ],
      vertexFunctions: "#include <gradient>",
      vertex: {
        color: colourStatements(plan, "scalar", (column, index) => {
          const value = `${attribute(column)} * u_value${index}.x + u_value${index}.y`;
          return `gradientColor(${toned ? `tone(clamp(${value}, 0.0, 1.0))` : value})`;
        }),
      },
    };
  },
};
