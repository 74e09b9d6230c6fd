import { frozen } from "../../options/index.js";
import type { TextureData } from "./shader.js";

/** A colour at a place of a gradient. */
export interface GradientStop {
  /** 0 to 1. */
  readonly at: number;
  /** sRGB, 0 to 1. */
  readonly color: readonly [number, number, number];
}

/** Gradients that there are; see `GRADIENTS` for where they are from. */
export type GradientName = "viridis" | "cividis" | "turbo" | "spectral" | "greyscale" | "terrain";

/** Equally spaced colours as hexadecimal numbers. */
function even(...hexes: number[]): GradientStop[] {
  return hexes.map((hex, index) => ({
    at: index / (hexes.length - 1),
    color: [(hex >> 16) / 255, ((hex >> 8) & 255) / 255, (hex & 255) / 255],
  }));
}

/**
 * `viridis`: S. van der Walt, N. Smith, "A Better Default Colormap for Matplotlib", 2015 (CC0); even in lightness and told
 * apart with any colour vision. `cividis`: J. Nuñez, C. Anderton, R. Renslow, PLOS ONE 13 (2018) (CC0 as in matplotlib);
 * the same for red-green blindness in hue too. `turbo`: A. Mikhailov, Google, 2019 (Apache-2.0), the polynomial's values.
 * `spectral`: ColorBrewer 2, C. Brewer (Apache-2.0), diverging, 11 classes, reversed. `greyscale` and `terrain` are own.
 */
export const GRADIENTS: Readonly<Record<GradientName, readonly GradientStop[]>> = frozen({
  viridis: even(
    ...[0x440154, 0x482475, 0x414487, 0x355f8d, 0x2a788e, 0x21918c],
    ...[0x22a884, 0x44bf70, 0x7ad151, 0xbddf26, 0xfde725],
  ),
  cividis: even(
    ...[0x002051, 0x0a326a, 0x2b446e, 0x4d566d, 0x696970, 0x7f7c75],
    ...[0x948f78, 0xada476, 0xcaba6a, 0xead156, 0xfdea45],
  ),
  turbo: even(
    ...[0x23171b, 0x493eae, 0x4569ee, 0x3295f7, 0x26bce1, 0x29dcbc, 0x3ff393, 0x65fd6e, 0x95fb51],
    ...[0xc5ec3c, 0xecd12e, 0xffad24, 0xff821d, 0xf05616, 0xcb2f0d, 0xa31302, 0x900c00],
  ),
  spectral: even(
    ...[0x5e4fa2, 0x3288bd, 0x66c2a5, 0xabdda4, 0xe6f598, 0xffffbf],
    ...[0xfee08b, 0xfdae61, 0xf46d43, 0xd53e4f, 0x9e0142],
  ),
  greyscale: even(0x000000, 0xffffff),
  terrain: even(0x2f6b4f, 0x6f9a4f, 0xc2b36b, 0xa97a4c, 0xd8cfc4, 0xffffff),
});

/** Their names. */
export const GRADIENT_NAMES = Object.keys(GRADIENTS) as readonly GradientName[];

/** A gradient's colour at a place, sRGB; beyond its ends the colour there. */
export function gradientAt(stops: readonly GradientStop[], at: number): [number, number, number] {
  const upper = stops.findIndex((stop) => stop.at >= at);
  if (upper <= 0) {
    const { color } = upper === 0 ? stops[0] : stops[stops.length - 1];
    return [...color];
  }
  const [a, b] = [stops[upper - 1], stops[upper]];
  const share = b.at > a.at ? (at - a.at) / (b.at - a.at) : 1;
  return a.color.map((part, i) => part + share * (b.color[i] - part)) as [number, number, number];
}

/** Texels of the texture of a gradient. */
const WIDTH = 256;

/** GLSL: colour of a gradient's texture at a place from 0 to 1. */
export const GRADIENT_COLOUR = `
vec3 gradientColor(float at) {
  float place = clamp(at, 0.0, 1.0) * ${(WIDTH - 1).toFixed(1)};
  int lower = min(int(place), ${WIDTH - 2});
  vec3 a = texelFetch(u_gradient, ivec2(lower, 0), 0).rgb;
  vec3 b = texelFetch(u_gradient, ivec2(lower + 1, 0), 0).rgb;
  return mix(a, b, place - float(lower));
}
`;

/** The texture of a gradient that is named, or given. */
export function gradientTexture(gradient: GradientName | readonly GradientStop[]): TextureData {
  const stops = typeof gradient === "string" ? GRADIENTS[gradient] : gradient;
  const data = new Uint8Array(4 * WIDTH);
  for (let texel = 0; texel < WIDTH; texel++) {
    const color = gradientAt(stops, texel / (WIDTH - 1));
    data.set([...color.map((part) => Math.round(255 * part)), 255], 4 * texel);
  }
  return { name: "u_gradient", width: WIDTH, height: 1, data };
}
