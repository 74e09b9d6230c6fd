import { number, parts } from "../../options/index.js";
import { colourBy, LEAST_SHARE } from "../declaration/colouring.js";
import { type Effect, showsColour } from "../declaration/effect.js";
import { optional, type StyleContext } from "../declaration/option.js";

/** A second colouring, and its share of a point's colour. */
export interface Blend {
  readonly color: string;
  /** 0 to 1. Default: 0.5. */
  readonly share: number;
}

/** The option of the effect `blend`. */
export interface BlendStyle {
  /** A second colouring mixed in with the share given. Default: none. */
  readonly blend: Blend | undefined;
}

/** Two colourings in one. */
export const blend: Effect<{ name: "blend"; own: BlendStyle }> = {
  name: "blend",
  options: {
    blend: optional(
      "STYLE_BLEND",
      parts<Blend, StyleContext>({ color: colourBy, share: number(0, 1) }, { share: 0.5 }),
    ),
  },
  unit: "share",
  threshold: LEAST_SHARE,
  source: "lesser share of the two colours; below half a step of 8 bits it shows nothing",
  forcible: "never",
  wish({ style, colourings }) {
    if (colourings.length === 2) return { kind: "asked", why: "the style blends two colourings" };
    const why = style.blend ? "one of the two colourings would not show" : "the style shows one colouring";
    return { kind: "off", why };
  },
  magnitude: ({ style }) => (style.blend ? Math.min(style.blend.share, 1 - style.blend.share) : 0),
  part: ({ pass }) =>
    showsColour(pass)
      ? {
          uniforms: [{ name: "u_blend", type: "float", scope: "layer" }],
          vertex: { color: "vec3 color = mix(color0, color1, u_blend);" },
        }
      : undefined,
  values: ({ style }) => ({ u_blend: style.blend?.share ?? 0 }),
};
