import { LEAST_SHARE, shareOf } from "../colouring.js";
import type { Effect } from "../effect.js";
import { showsColour } from "../part.js";
import type { PointCloudStyle } from "../style.js";

/** Gamma, brightness and contrast: exponent, summand, slope around the middle. */
function toneOf({ gamma, brightness, contrast }: PointCloudStyle): [number, number, number] {
  return [gamma, brightness, contrast < 0 ? 1 + contrast : 1 / Math.max(1 - contrast, 1e-3)];
}

/** Gamma, brightness and contrast of recorded colours, and of values before the gradient. */
export const tone: Effect = {
  name: "tone",
  unit: "share",
  threshold: LEAST_SHARE,
  source: "greatest change of a value from 0 to 1; below half a step of 8 bits it shows nothing",
  wish: (scene) => {
    if (shareOf(scene, "own") + shareOf(scene, "scalar") === 0) {
      return { kind: "off", why: "classes and levels keep their colours" };
    }
    return { kind: "asked", why: "the style changes gamma, brightness or contrast" };
  },
  magnitude({ style }) {
    const [gamma, brightness, slope] = toneOf(style);
    let most = 0;
    for (let value = 0; value <= 1; value += 1 / 64) {
      const toned = (value ** gamma + brightness - 0.5) * slope + 0.5;
      most = Math.max(most, Math.abs(Math.min(Math.max(toned, 0), 1) - value));
    }
    return most;
  },
  part: ({ pass }) =>
    showsColour(pass)
      ? { uniforms: [{ name: "u_tone", type: "vec3", scope: "layer" }], vertexFunctions: "#include <tone>" }
      : undefined,
  values: ({ style }) => ({ u_tone: toneOf(style) }),
};
