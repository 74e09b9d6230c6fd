import type { Effect } from "../declaration/effect.js";
import { DISC, type ShapeStyle } from "../declaration/points.js";

/** Round points (thesis, 4.2.1). */
export const disc: Effect<{ name: "disc"; reads: ShapeStyle; words: { shape: "disc" } }> = {
  name: "disc",
  group: "shapes",
  words: { shape: "disc" },
  options: {},
  unit: "px",
  threshold: 0.25,
  source: "what a square's corner juts out over the disc, (√2 − 1) / 2 · width (thesis, 4.2.1)",
  wish: ({ style }) =>
    style.shape === "square"
      ? { kind: "off", why: "the style asks for squares" }
      : { kind: "asked", why: "the style asks for round points" },
  magnitude: ({ width }) => ((Math.SQRT2 - 1) / 2) * width,
  part: () => ({ fragment: { shape: DISC } }),
};
