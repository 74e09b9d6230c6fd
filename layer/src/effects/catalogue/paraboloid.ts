import type { Effect } from "../declaration/effect.js";
import { DISC, PIXELS_PER_METRE, type ShapeStyle } from "../declaration/points.js";

/**
 * Points as paraboloids, so that neighbours meet half way as in a Voronoi diagram (thesis, 4.2.3; M. Schütz, M. Wimmer,
 * "High-Quality Point Based Rendering Using Fast Single Pass Interpolation", 2015). The apex is at the point's own depth
 * and the rim recedes by the radius, so that nothing is drawn nearer than it is.
 */
export const paraboloid: Effect<{
  name: "paraboloid";
  reads: ShapeStyle;
  words: { shape: "paraboloid" };
}> = {
  name: "paraboloid",
  group: "shapes",
  words: { shape: "paraboloid" },
  options: {},
  unit: "px",
  threshold: 3,
  source: "overlap of neighbouring points, width − spacing (thesis, 4.2.3)",
  wish: ({ style }) =>
    style.shape === "paraboloid"
      ? { kind: "asked", why: "the style asks for paraboloids, and points overlap" }
      : { kind: "off", why: `the style asks for ${style.shape}s` },
  magnitude: ({ overlap }) => overlap,
  part: ({ target }) => ({
    varyings: [{ name: "v_paraboloid", type: "vec2" }],
    vertexFunctions: [PIXELS_PER_METRE.functions],
    vertex: {
      measure: PIXELS_PER_METRE.measure,
      hand: "v_paraboloid = vec2(eye.z, 0.5 * width / scale);",
    },
    fragmentFunctions: [target.writeDepth],
    fragment: { shape: DISC, depth: "writeDepth(v_paraboloid.x - v_paraboloid.y * squared);" },
  }),
};
