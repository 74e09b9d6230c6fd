import type { Effect } from "../effect.js";
import { type Part, showsColour } from "../part.js";
import { CLIP_ROLES } from "./clip.js";

/** Points inside volumes that highlight, in another colour (thesis, 5.3.3). */
export const highlight: Effect = {
  name: "highlight",
  unit: "1",
  threshold: 1,
  source: "number of volumes that highlight (thesis, 5.3.3)",
  wish: ({ facts }) =>
    facts.highlights > 0
      ? { kind: "asked", why: "volumes highlight points" }
      : { kind: "off", why: "there is no volume that highlights" },
  magnitude: ({ facts }) => facts.highlights,
  part({ pass }): Part | undefined {
    if (!showsColour(pass)) return undefined;
    return {
      uniforms: [...CLIP_ROLES.uniforms, { name: "u_highlight", type: "vec4", scope: "layer" }],
      vertexFunctions: CLIP_ROLES.vertexFunctions,
      vertex: {
        locate: CLIP_ROLES.locate,
        color: "if (roles.w > 0) color = mix(color, u_highlight.rgb, u_highlight.a);",
      },
    };
  },
  values: ({ style }) => ({ u_highlight: [...style.highlight.color, style.highlight.share] }),
};
