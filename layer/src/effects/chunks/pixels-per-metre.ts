/** Pixels that a metre across the view takes at the clip coordinate w of a point (thesis, eq. 4.3); orthographic: w = 1. */
export const PIXELS_PER_METRE = `
float pixelsPerMetre(float w) {
  return 0.5 * $projection[1][1] * $viewport.w / w;
}
`;
