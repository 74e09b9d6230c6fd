import { LEAST_SHARE, shareOf } from "../colouring.js";
import type { Effect } from "../effect.js";
import { drawsOffscreen } from "../effect-plan.js";

/** Noise of half a step of 8 bits against bands, by three.js' chunk; where a quad finishes the picture, it does it. */
export const dithering: Effect = {
  name: "dithering",
  unit: "share",
  threshold: LEAST_SHARE,
  source: "half a step of 8 bits where colours are smooth: gradients and shading",
  wish: ({ style }) =>
    style.dithering
      ? { kind: "asked", why: "the style asks for it" }
      : { kind: "off", why: "the style does not ask for it" },
  magnitude(scene) {
    const smooth = shareOf(scene, "scalar") > 0 || scene.style.eyeDomeLighting !== false;
    return smooth ? LEAST_SHARE : 0;
  },
  part({ plan, pass }) {
    if (pass !== "color" || drawsOffscreen(plan)) return undefined;
    return DITHERING;
  },
};

/** Three's chunks as they are: `rand` is in its `common`, and its switch is a macro. */
export const DITHERING = {
  fragmentFunctions: "#define DITHERING\n#include <three/common>\n#include <three/dithering_pars_fragment>",
  fragment: { finish: "out_FragColor.rgb = dithering(out_FragColor.rgb);" },
} as const;
