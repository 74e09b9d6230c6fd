import type { Effect } from "../effect.js";
import { pointWidth } from "../widths.js";

/** Leaves of a point's square the disc (thesis, 4.2.1); `squared` is the squared distance from its centre. */
export const DISC =
  "vec2 offset = 2.0 * gl_PointCoord - 1.0;\nfloat squared = dot(offset, offset);\nif (squared > 1.0) discard;";

/** Round points (thesis, 4.2.1). */
export const disc: Effect = {
  name: "disc",
  unit: "px",
  threshold: 0.25,
  source: "what a square's corner juts out over the disc, (√2 − 1) / 2 · width (thesis, 4.2.1)",
  wish: ({ style }) =>
    style.shape === "square"
      ? { kind: "off", why: "the style asks for squares" }
      : { kind: "asked", why: "the style asks for round points" },
  magnitude: (scene) => ((Math.SQRT2 - 1) / 2) * pointWidth(scene),
  part: () => ({ fragment: { shape: DISC } }),
};
