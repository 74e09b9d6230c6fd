import { number } from "../../options/index.js";
import type { Effect } from "../declaration/effect.js";
import { option } from "../declaration/option.js";
import { overlapBeside, type SizeStyle } from "../declaration/points.js";

/** The option of the effect `fixedSize`. */
export interface FixedSizeStyle {
  /** Width of a point where the size is fixed, CSS pixels, 1 to 64. Default: 2. */
  readonly pointSize: number;
}

/** Points of one width on screen (thesis, 4.3.1). */
export const fixedSize: Effect<{
  name: "fixedSize";
  own: FixedSizeStyle;
  reads: SizeStyle;
  words: { size: "fixed" };
}> = {
  name: "fixedSize",
  group: "sizes",
  words: { size: "fixed" },
  options: { pointSize: option("STYLE_POINT_SIZE", number(1, 64), 2) },
  unit: "px",
  threshold: 0,
  source: "width of a point on screen (thesis, 4.3.1)",
  widths: {
    widest: ({ style, facts }) => style.pointSize * facts.pixelRatio,
    overlap: overlapBeside,
    limit: ({ pointSize }) => pointSize,
  },
  wish: ({ style }) =>
    style.size === "fixed"
      ? { kind: "asked", why: "the style asks for one size" }
      : { kind: "off", why: `the style asks for ${style.size} sizes` },
  magnitude: ({ style, facts }) => style.pointSize * facts.pixelRatio,
  lastResort: ({ size }) => (size === "fixed" ? "a point needs a size" : undefined),
  part: () => ({
    uniforms: [{ name: "u_pointSize", type: "float", scope: "layer" }],
    vertex: { size: "float width = u_pointSize * $pixelRatio;\ngl_PointSize = width;" },
  }),
  values: ({ style }) => ({ u_pointSize: style.pointSize }),
};
