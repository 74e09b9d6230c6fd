import type { Effect } from "../effect.js";
import { pointWidth } from "../widths.js";

/** Points of one width on the ground (thesis, 4.3.2). */
export const attenuatedSize: Effect = {
  name: "attenuatedSize",
  unit: "px",
  threshold: 0,
  source:
    "width of the nearest points on screen, factor · d · h / (2 tan(fov / 2) depth) (thesis, eq. 4.3), d the median distance between drawn points over the picture",
  wish: ({ style }) =>
    style.size === "attenuated"
      ? { kind: "asked", why: "the style asks for one size on the ground" }
      : { kind: "off", why: `the style asks for ${style.size} sizes` },
  magnitude: pointWidth,
  part: () => ({
    uniforms: [
      { name: "u_groundSize", type: "float", scope: "layer" },
      { name: "u_sizeLimits", type: "vec2", scope: "layer" },
    ],
    vertexFunctions: "#include <pixelsPerMetre>",
    vertex: {
      measure: "float scale = pixelsPerMetre(gl_Position.w);",
      size:
        "float width = clamp(u_groundSize * scale, u_sizeLimits.x * $pixelRatio, u_sizeLimits.y * $pixelRatio);\n" +
        "gl_PointSize = width;",
    },
  }),
  values: ({ style, facts }) => ({
    u_groundSize: style.spacingFactor * facts.groundSpacing,
    u_sizeLimits: [style.minimumSize, style.maximumSize],
  }),
};
