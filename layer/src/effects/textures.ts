import { GRADIENT_WIDTH } from "./chunks/gradient.js";
import type { EffectPlan } from "./effect-plan.js";
import { type PointFilter, showsClass } from "./filter.js";
import { type GradientName, type GradientStop, gradientAt, stopsOf } from "./gradients.js";
import type { PointCloudStyle } from "./style.js";

/** A texture that a program reads by texel, without filtering or mipmaps. */
export interface TextureData {
  /** Name of the sampler. */
  readonly name: string;
  readonly width: number;
  readonly height: number;
  /** RGBA, 8 bits each (`Uint8Array`) or floats (`Float32Array`: RGBA32F), row by row. */
  readonly data: Uint8Array | Float32Array;
}

/**
 * Textures that the style and the filter fill; those of the visible octree and of clips belong to the nodes drawn. To be
 * formed anew when the style or the filter changes.
 */
export function styleTextures(plan: EffectPlan, style: PointCloudStyle): TextureData[] {
  const textures: TextureData[] = [];
  if (plan.active.has("gradient") || plan.active.has("levelOfDetail")) {
    textures.push(gradientTexture(gradientOf(style)));
  }
  if (plan.active.has("classification") || plan.filters.classes) {
    textures.push(classTexture(style, plan.filters.classes ? plan.filters.filter : undefined));
  }
  return textures;
}

/** The gradient that a style shows its first colouring with. */
export function gradientOf({ gradient, color }: PointCloudStyle): GradientName | readonly GradientStop[] {
  if (gradient !== "auto") return gradient;
  return color === "intensity" ? "greyscale" : "viridis";
}

function gradientTexture(gradient: GradientName | readonly GradientStop[]): TextureData {
  const stops = stopsOf(gradient);
  const data = new Uint8Array(4 * GRADIENT_WIDTH);
  for (let texel = 0; texel < GRADIENT_WIDTH; texel++) {
    const color = gradientAt(stops, texel / (GRADIENT_WIDTH - 1));
    data.set([...color.map((part) => Math.round(255 * part)), 255], 4 * texel);
  }
  return { name: "u_gradient", width: GRADIENT_WIDTH, height: 1, data };
}

/** Colours of the 256 classes; alpha says which are shown. */
function classTexture(style: PointCloudStyle, filter: PointFilter | undefined): TextureData {
  const data = new Uint8Array(4 * 256);
  for (let number = 0; number < 256; number++) {
    const color = style.classes[number].color.map((part) => Math.round(255 * part));
    data.set([...color, showsClass(style, filter, number) ? 255 : 0], 4 * number);
  }
  return { name: "u_classes", width: 256, height: 1, data };
}
