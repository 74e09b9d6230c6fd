import { colour, number, parts } from "../../options/index.js";
import { CLIP_READING } from "../declaration/clip-reading.js";
import { type Effect, showsColour } from "../declaration/effect.js";
import { option } from "../declaration/option.js";

/** How points inside volumes that highlight look. */
export interface Highlight {
  /** sRGB, 0 to 1. Default: red. */
  readonly color: readonly [number, number, number];
  /** Its share of a point's colour, 0 to 1. Default: 0.6. */
  readonly share: number;
}

/** The option of the effect `highlight`. */
export interface HighlightStyle {
  /** Colour, and its share, of points inside volumes that highlight. Default: red, 0.6. */
  readonly highlight: Highlight;
}

/** Points inside volumes that highlight, in another colour (thesis, 5.3.3). */
export const highlight: Effect<{ name: "highlight"; own: HighlightStyle }> = {
  name: "highlight",
  options: {
    highlight: option("STYLE_HIGHLIGHT", parts<Highlight>({ color: colour, share: number(0, 1) }), {
      color: [1, 0, 0],
      share: 0.6,
    }),
  },
  nodeTexture: "clips",
  forcible: "off",
  unit: "1",
  threshold: 1,
  source: "number of volumes that highlight (thesis, 5.3.3)",
  wish: ({ facts }) =>
    facts.highlights > 0
      ? { kind: "asked", why: "volumes highlight points" }
      : { kind: "off", why: "there is no volume that highlights" },
  magnitude: ({ facts }) => facts.highlights,
  part({ pass }) {
    if (!showsColour(pass)) return undefined;
    return {
      uniforms: [...CLIP_READING.uniforms, { name: "u_highlight", type: "vec4", scope: "layer" }],
      vertexFunctions: [CLIP_READING.functions],
      vertex: {
        locate: CLIP_READING.locate,
        color: "if (roles.w > 0) color = mix(color, u_highlight.rgb, u_highlight.a);",
      },
    };
  },
  values: ({ style }) => ({ u_highlight: [...style.highlight.color, style.highlight.share] }),
};
