import { number } from "../../options/index.js";
import type { Effect } from "../declaration/effect.js";
import { onOffOrAuto, option } from "../declaration/option.js";
import { DISC, PIXELS_PER_METRE } from "../declaration/points.js";
import { FRONT } from "../declaration/shader.js";

/** The options of the effect `splats`. */
export interface SplatStyle {
  /** Blends overlapping points in three passes (thesis, 4.2.2); `auto`: where they overlap by 3 px. Default: false. */
  readonly splats: boolean | "auto";
  /** Exponent of a splat's weight, eq. 4.1; 0.5 to 50. Default: 2. */
  readonly hardness: number;
}

/** An eye position moved towards the camera, along the ray through it, by metres of depth. */
const NEARER = `
vec4 nearer(vec4 eye, float metres) {
  vec3 ray = $projection[3][3] == 0.0 ? eye.xyz / eye.z : vec3(0.0, 0.0, 1.0);
  return vec4(eye.xyz + ray * min(metres, 0.5 * abs(eye.z)), 1.0);
}
`;

/** Drawing-buffer pixels. Up to this width a point covers no more than the four pixels around its place. */
const NARROW = 2;

/**
 * Whether all four pixels around a narrow point show something nearer than it, so that it would fail each depth test. The
 * point is taken to be four steps of a depth buffer of 24 bits nearer than it is: rounding leaves out none that shows.
 */
const HIDDEN = `
bool hidden(vec3 place) {
  ivec2 last = textureSize(${FRONT}, 0) - 1;
  ivec2 corner = ivec2(floor((place.xy * 0.5 + 0.5) * vec2(last + 1) - 0.5));
  ivec2 low = clamp(corner, ivec2(0), last);
  ivec2 high = clamp(corner + 1, ivec2(0), last);
  float below = max(texelFetch(${FRONT}, low, 0).r, texelFetch(${FRONT}, ivec2(high.x, low.y), 0).r);
  float above = max(texelFetch(${FRONT}, ivec2(low.x, high.y), 0).r, texelFetch(${FRONT}, high, 0).r);
  return place.z * 0.5 + 0.5 > max(below, above) + 2.5e-7;
}
`;

/**
 * Overlapping points blended by weight in three passes: depth, weighted sum, normalisation (thesis, 4.2.2). Blended is
 * what lies within a point's own radius behind the nearest: the sum's points are drawn that much nearer and held
 * against the depth of the first pass, which stays true. Narrow points that are hidden are left out of the second pass before
 * they are rasterised: where there are many points, that is half of them.
 */
export const splats: Effect<{ name: "splats"; own: SplatStyle; variant: boolean }> = {
  name: "splats",
  group: "shapes",
  pass: ["depth", "splat"],
  options: {
    splats: option("STYLE_SPLATS", onOffOrAuto, false),
    hardness: option("STYLE_SPLATS", number(0.5, 50), 2),
  },
  unit: "px",
  threshold: 3,
  source: "overlap of neighbouring points, width − spacing (thesis, 4.2.2)",
  wish({ style }) {
    if (style.splats === false) return { kind: "off", why: "the style does not ask for it" };
    return style.splats === true
      ? { kind: "forced", why: "the style asks for splats" }
      : { kind: "auto", why: "points overlap" };
  },
  magnitude: ({ overlap }) => overlap,
  /** Whether hidden points are left out. */
  variant: ({ width }) => width <= NARROW,
  readsFront: (narrow) => narrow,
  part({ pass, variant: narrow }) {
    if (pass !== "splat") return { fragment: { shape: DISC } };
    return {
      uniforms: [
        { name: "u_hardness", type: "float", scope: "layer" },
        { name: FRONT, type: "sampler2D", scope: "view" },
      ],
      vertexFunctions: [PIXELS_PER_METRE.functions, NEARER, ...(narrow ? [HIDDEN] : [])],
      vertex: {
        measure: PIXELS_PER_METRE.measure,
        place: "gl_Position = $projection * nearer(eye, 0.5 * width / scale);",
        ...(narrow && {
          hand: `if (width <= ${NARROW.toFixed(1)} && hidden(gl_Position.xyz / gl_Position.w)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);`,
        }),
      },
      fragment: {
        shape: DISC,
        output:
          "float weight = pow(1.0 - squared, u_hardness);\nout_FragColor = vec4(v_color * weight, weight);",
      },
    };
  },
  quad: () => ({
    statements: { resolve: "if (sum.a <= 0.0) discard;\nvec3 color = sum.rgb / sum.a;" },
  }),
  values: ({ style }) => ({ u_hardness: style.hardness }),
};
