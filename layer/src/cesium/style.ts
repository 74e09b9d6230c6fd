import { StyleError } from "../errors/index.js";

/** What a point's colour shows. */
export type ColourBy = "rgb" | "elevation" | "intensity";

/** How points are drawn. */
export interface PointCloudStyle {
  /** Default: `rgb` where the scan has colours, else `elevation`. */
  readonly color: ColourBy;
  /** Edge of a point's square in CSS pixels, 1 to 64. Default: 2. */
  readonly pointSize: number;
}

const COLOURS: readonly string[] = ["rgb", "elevation", "intensity"] satisfies ColourBy[];

/**
 * A whole style of the parts given, the rest from `base`.
 * @param hasColour whether the scan has colours of its own
 * @throws StyleError STYLE_COLOR, STYLE_NO_RGB, STYLE_POINT_SIZE
 */
export function completeStyle(
  parts: Partial<PointCloudStyle>,
  base: PointCloudStyle,
  hasColour: boolean,
  file: string,
): PointCloudStyle {
  const style: PointCloudStyle = { ...base, ...parts };
  if (!COLOURS.includes(style.color)) {
    throw new StyleError({
      code: "STYLE_COLOR",
      file,
      cause: `there is no colouring by "${style.color}"`,
      fix: `Use one of ${COLOURS.join(", ")}`,
    });
  }
  if (style.color === "rgb" && !hasColour) {
    throw new StyleError({
      code: "STYLE_NO_RGB",
      file,
      cause: "the scan has no colours of its own",
      fix: "Use elevation or intensity",
    });
  }
  if (!(style.pointSize >= 1 && style.pointSize <= 64)) {
    throw new StyleError({
      code: "STYLE_POINT_SIZE",
      file,
      cause: `a point cannot be ${style.pointSize} pixels large`,
      fix: "Use a size from 1 to 64",
    });
  }
  return style;
}

/** The style of a layer that was given none. */
export function defaultStyle(hasColour: boolean): PointCloudStyle {
  return { color: hasColour ? "rgb" : "elevation", pointSize: 2 };
}
