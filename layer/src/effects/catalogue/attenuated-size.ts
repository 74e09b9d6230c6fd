import { number } from "../../options/index.js";
import type { Effect } from "../declaration/effect.js";
import { option } from "../declaration/option.js";
import { limitedWidth, overlapBeside, PIXELS_PER_METRE, type SizeStyle } from "../declaration/points.js";

/** How wide points are that go by the distance between them. */
export interface SpacedSizeStyle {
  /**
   * Width of a point as a multiple of the spacing where the size is attenuated or adaptive, 0.1 to 10. 1 closes a square
   * grid of squares, √2 one of discs. 2 closes any maximal Poisson-disc sample, in which a radius of one spacing around
   * each point leaves nothing out; it is the radius of eq. 4.4 of the thesis. Default: 2.
   */
  readonly spacingFactor: number;
  /** Least width where the size is attenuated or adaptive, CSS pixels, 0 to 256. Default: 1. */
  readonly minimumSize: number;
  /** Greatest width where the size is attenuated or adaptive, CSS pixels, 1 to 256. Default: 50. */
  readonly maximumSize: number;
}

/** Points of one width on the ground (thesis, 4.3.2). */
export const attenuatedSize: Effect<{
  name: "attenuatedSize";
  own: SpacedSizeStyle;
  reads: SizeStyle;
  words: { size: "attenuated" };
}> = {
  name: "attenuatedSize",
  group: "sizes",
  words: { size: "attenuated" },
  options: {
    spacingFactor: option("STYLE_POINT_SIZE", number(0.1, 10), 2),
    minimumSize: option("STYLE_POINT_SIZE", number(0, 256), 1),
    maximumSize: option("STYLE_POINT_SIZE", number(1, 256), 50, {
      agrees({ minimumSize, maximumSize }, place) {
        if (Number(maximumSize) >= Number(minimumSize)) return;
        place.refuse(
          `sizes cannot run from ${minimumSize} to ${maximumSize} pixels`,
          "use a maximumSize that is at least as large as minimumSize",
        );
      },
    }),
  },
  unit: "px",
  threshold: 0,
  source:
    "width of the nearest points on screen, factor · d · h / (2 tan(fov / 2) depth) (thesis, eq. 4.3), d the median distance between drawn points over the picture",
  widths: {
    widest(scene) {
      const { groundSpacing, pixelsPerMetre } = scene.facts;
      return limitedWidth(scene.style.spacingFactor * groundSpacing * pixelsPerMetre, scene);
    },
    overlap: overlapBeside,
    limit: ({ maximumSize }) => maximumSize,
  },
  wish: ({ style }) =>
    style.size === "attenuated"
      ? { kind: "asked", why: "the style asks for one size on the ground" }
      : { kind: "off", why: `the style asks for ${style.size} sizes` },
  magnitude: ({ width }) => width,
  lastResort: ({ size }) =>
    size === "fixed" ? undefined : "one size on the ground shows the same as adaptive sizes",
  part: () => ({
    uniforms: [
      { name: "u_groundSize", type: "float", scope: "layer" },
      { name: "u_sizeLimits", type: "vec2", scope: "layer" },
    ],
    vertexFunctions: [PIXELS_PER_METRE.functions],
    vertex: {
      measure: PIXELS_PER_METRE.measure,
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
