import { FRAGMENT_DEPTH } from "../chunks/fragment-depth.js";
import type { Effect } from "../effect.js";
import { pointOverlap } from "../widths.js";
import { DISC } from "./disc.js";

/**
 * Points as paraboloids, so that neighbours meet half way as in a Voronoi diagram (thesis, 4.2.3; M. Schütz, M. Wimmer,
 * "High-Quality Point Based Rendering Using Fast Single Pass Interpolation", 2015). The apex is at the point's own depth
 * and the rim recedes by the radius, so that nothing is drawn nearer than it is.
 */
export const paraboloid: Effect = {
  name: "paraboloid",
  unit: "px",
  threshold: 3,
  source: "overlap of neighbouring points, width − spacing (thesis, 4.2.3)",
  wish: ({ style }) =>
    style.shape === "paraboloid"
      ? { kind: "asked", why: "the style asks for paraboloids, and points overlap" }
      : { kind: "off", why: `the style asks for ${style.shape}s` },
  magnitude: pointOverlap,
  part: ({ target }) => ({
    varyings: [{ name: "v_paraboloid", type: "vec2" }],
    vertexFunctions: "#include <pixelsPerMetre>",
    vertex: {
      measure: "float scale = pixelsPerMetre(gl_Position.w);",
      hand: "v_paraboloid = vec2(eye.z, 0.5 * width / scale);",
    },
    fragmentFunctions: FRAGMENT_DEPTH[target],
    fragment: { shape: DISC, depth: "writeDepth(v_paraboloid.x - v_paraboloid.y * squared);" },
  }),
};
