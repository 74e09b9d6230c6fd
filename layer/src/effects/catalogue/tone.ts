import { number } from "../../options/index.js";
import { LEAST_SHARE, shareOf } from "../declaration/colouring.js";
import { type Effect, showsColour } from "../declaration/effect.js";
import { option } from "../declaration/option.js";

/** Gamma, brightness and contrast. */
export interface ToneStyle {
  /** Exponent over colours, and over values before the gradient; 0.1 to 10. Default: 1. */
  readonly gamma: number;
  /** Added after gamma; −1 to 1. Default: 0. */
  readonly brightness: number;
  /** Steepness around the middle: −1 flattens to grey, 0 leaves as it is, 1 is a step. Default: 0. */
  readonly contrast: number;
}

/** u_tone is the exponent, the summand and the slope around the middle. */
const TONE = `
float tone(float value) {
  return clamp((pow(value, u_tone.x) + u_tone.y - 0.5) * u_tone.z + 0.5, 0.0, 1.0);
}
vec3 tone(vec3 value) {
  return vec3(tone(value.r), tone(value.g), tone(value.b));
}
`;

/** Exponent, summand, slope around the middle. */
export function toneOf({ gamma, brightness, contrast }: ToneStyle): [number, number, number] {
  return [gamma, brightness, contrast < 0 ? 1 + contrast : 1 / Math.max(1 - contrast, 1e-3)];
}

/** Gamma, brightness and contrast of recorded colours, and of values before the gradient. */
export const tone: Effect<{ name: "tone"; own: ToneStyle }> = {
  name: "tone",
  options: {
    gamma: option("STYLE_TONE", number(0.1, 10), 1),
    brightness: option("STYLE_TONE", number(-1, 1), 0),
    contrast: option("STYLE_TONE", number(-1, 1), 0),
  },
  unit: "share",
  threshold: LEAST_SHARE,
  source: "greatest change of a value from 0 to 1; below half a step of 8 bits it shows nothing",
  wish: (scene) =>
    shareOf(scene, ({ toned }) => toned === true) > 0
      ? { kind: "asked", why: "the style changes gamma, brightness or contrast" }
      : { kind: "off", why: "classes and levels keep their colours" },
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
      ? { uniforms: [{ name: "u_tone", type: "vec3", scope: "layer" }], vertexFunctions: [TONE] }
      : undefined,
  values: ({ style }) => ({ u_tone: toneOf(style) }),
};
