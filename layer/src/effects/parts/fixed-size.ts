import type { Effect } from "../effect.js";

/** Points of one width on screen (thesis, 4.3.1). */
export const fixedSize: Effect = {
  name: "fixedSize",
  unit: "px",
  threshold: 0,
  source: "width of a point on screen (thesis, 4.3.1)",
  wish: ({ style }) =>
    style.size === "fixed"
      ? { kind: "asked", why: "the style asks for one size" }
      : { kind: "off", why: `the style asks for ${style.size} sizes` },
  magnitude: ({ style, facts }) => style.pointSize * facts.pixelRatio,
  part: () => ({
    uniforms: [{ name: "u_pointSize", type: "float", scope: "layer" }],
    vertex: { size: "float width = u_pointSize * $pixelRatio;\ngl_PointSize = width;" },
  }),
  values: ({ style }) => ({ u_pointSize: style.pointSize }),
};
