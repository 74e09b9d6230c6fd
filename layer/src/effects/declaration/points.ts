import type { Scene } from "./effect.js";

/** The part of a style that says how the size of a point comes about. */
export interface SizeStyle {
  readonly size: string;
}

/** A width that follows spacings, between the style's limits; drawing-buffer pixels. */
export function limitedWidth(
  width: number,
  {
    style: { minimumSize, maximumSize },
    facts: { pixelRatio },
  }: Pick<Scene<{ readonly minimumSize: number; readonly maximumSize: number }>, "style" | "facts">,
): number {
  return Math.min(Math.max(width, minimumSize * pixelRatio), maximumSize * pixelRatio);
}

/** Pixels by which points of one width overlap where they lie closest together. */
export function overlapBeside(width: number, { facts }: Pick<Scene<unknown>, "facts">): number {
  return Math.max(0, width - facts.spacings[0]);
}

/** GLSL: pixels that a metre across the view takes at the clip coordinate w of a point (thesis, eq. 4.3); orthographic: w = 1. */
export const PIXELS_PER_METRE = {
  functions: `
float pixelsPerMetre(float w) {
  return 0.5 * $projection[1][1] * $viewport.w / w;
}
`,
  measure: "float scale = pixelsPerMetre(gl_Position.w);",
} as const;

/** Leaves of a point's square the disc (thesis, 4.2.1); `squared` is the squared distance from its centre. */
export const DISC =
  "vec2 offset = 2.0 * gl_PointCoord - 1.0;\nfloat squared = dot(offset, offset);\nif (squared > 1.0) discard;";

/** The part of a style that says what a point is drawn as. */
export interface ShapeStyle {
  readonly shape: string;
}
