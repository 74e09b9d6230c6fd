/// <reference path="./three-chunk.d.ts" />
import common from "three/src/renderers/shaders/ShaderChunk/common.glsl.js";
import ditheringFunction from "three/src/renderers/shaders/ShaderChunk/dithering_pars_fragment.glsl.js";
import { flag } from "../../options/index.js";
import { LEAST_SHARE, shareOf } from "../declaration/colouring.js";
import type { Effect } from "../declaration/effect.js";
import { option } from "../declaration/option.js";
import type { EyeDomeStyle } from "./eye-dome-lighting.js";

/** The option of the effect `dithering`. */
export interface DitheringStyle {
  /** Breaks up bands of 8-bit colour by noise of half a step. Default: false. */
  readonly dithering: boolean;
}

/**
 * Three's chunks as they are: `rand` is in its `common`, and its switch is a macro. They are imported as single files:
 * all of three's chunks in one object would be 178 kB that no bundler can shake.
 */
const FUNCTIONS = ["#define DITHERING", common, ditheringFunction];
const FINISH = "out_FragColor.rgb = dithering(out_FragColor.rgb);";

/** Noise of half a step of 8 bits against bands, by three.js' chunk; where a quad finishes the picture, it does it. */
export const dithering: Effect<{ name: "dithering"; own: DitheringStyle; reads: EyeDomeStyle }> = {
  name: "dithering",
  options: { dithering: option("STYLE_DITHERING", flag, false) },
  unit: "share",
  threshold: LEAST_SHARE,
  source: "half a step of 8 bits where colours are smooth: gradients and shading",
  wish: ({ style }) =>
    style.dithering
      ? { kind: "asked", why: "the style asks for it" }
      : { kind: "off", why: "the style does not ask for it" },
  magnitude(scene) {
    const smooth = shareOf(scene, ({ smooth }) => smooth === true) > 0;
    return smooth || scene.style.eyeDomeLighting !== false ? LEAST_SHARE : 0;
  },
  part: ({ offscreen, pass }) =>
    pass === "color" && !offscreen
      ? { fragmentFunctions: FUNCTIONS, fragment: { finish: FINISH } }
      : undefined,
  quad: () => ({ functions: FUNCTIONS, statements: { finish: FINISH } }),
};
