import { number } from "../../options/index.js";
import { LEAST_SHARE } from "../declaration/colouring.js";
import type { Effect } from "../declaration/effect.js";
import { option } from "../declaration/option.js";

/** The option of the effect `opacity`. */
export interface OpacityStyle {
  /** Of the cloud as a whole; 0 to 1. Default: 1. */
  readonly opacity: number;
}

/**
 * The picture of the points, as a whole, lets the scene through; the quad that puts it there does it. Points that were
 * translucent one by one would add up to an opaque heap.
 */
export const opacity: Effect<{ name: "opacity"; own: OpacityStyle }> = {
  name: "opacity",
  pass: "quad",
  translucent: true,
  options: { opacity: option("STYLE_OPACITY", number(0, 1), 1) },
  unit: "share",
  threshold: LEAST_SHARE,
  source: "1 − opacity; below half a step of 8 bits it shows nothing",
  wish: () => ({ kind: "asked", why: "the style asks for translucency" }),
  magnitude: ({ style }) => 1 - style.opacity,
  quad: () => ({
    uniforms: [{ name: "u_opacity", type: "float", scope: "layer" }],
    statements: { finish: "out_FragColor.a *= u_opacity;" },
  }),
  values: ({ style }) => ({ u_opacity: style.opacity }),
};
