import type { Effect } from "../effect.js";
import { pointOverlap } from "../widths.js";
import { DISC } from "./disc.js";

/**
 * Overlapping points blended by weight in three passes: depth, weighted sum, normalisation (thesis, 4.2.2). Blended is
 * what lies within a point's own radius behind the nearest: the sum's points are drawn that much nearer and held
 * against the depth of the first pass, which stays true.
 */
export const splats: Effect = {
  name: "splats",
  unit: "px",
  threshold: 3,
  source: "overlap of neighbouring points, width − spacing (thesis, 4.2.2)",
  wish({ style }) {
    if (style.highQuality === false) return { kind: "off", why: "the style does not ask for it" };
    return style.highQuality === true
      ? { kind: "forced", why: "the style asks for high quality" }
      : { kind: "auto", why: "points overlap" };
  },
  magnitude: pointOverlap,
  part({ pass }) {
    if (pass !== "splat") return { fragment: { shape: DISC } };
    return {
      uniforms: [{ name: "u_hardness", type: "float", scope: "layer" }],
      vertexFunctions: "#include <pixelsPerMetre>\n#include <nearer>",
      vertex: {
        measure: "float scale = pixelsPerMetre(gl_Position.w);",
        place: "gl_Position = $projection * nearer(eye, 0.5 * width / scale);",
      },
      fragment: {
        shape: DISC,
        output:
          "float weight = pow(1.0 - squared, u_hardness);\nout_FragColor = vec4(v_color * weight, weight);",
      },
    };
  },
  values: ({ style }) => ({ u_hardness: style.hardness }),
};
