import { LEAST_SHARE } from "../colouring.js";
import type { Effect } from "../effect.js";

/** The picture of the points, as a whole, lets the scene through; the quad that puts it there does it. */
export const opacity: Effect = {
  name: "opacity",
  unit: "share",
  threshold: LEAST_SHARE,
  source: "1 − opacity; below half a step of 8 bits it shows nothing",
  wish: () => ({ kind: "asked", why: "the style asks for translucency" }),
  magnitude: ({ style }) => 1 - style.opacity,
  values: ({ style }) => ({ u_opacity: style.opacity }),
};
