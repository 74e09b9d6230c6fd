import { LEAST_SHARE } from "../colouring.js";
import type { Effect } from "../effect.js";
import { showsColour } from "../part.js";

/** Two colourings in one. */
export const blend: Effect = {
  name: "blend",
  unit: "share",
  threshold: LEAST_SHARE,
  source: "lesser share of the two colours; below half a step of 8 bits it shows nothing",
  wish: ({ style }) =>
    style.blend
      ? { kind: "asked", why: "the style blends two colourings" }
      : { kind: "off", why: "the style shows one colouring" },
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
