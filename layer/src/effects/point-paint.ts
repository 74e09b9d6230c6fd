import { rangeOf, styleGradient } from "./catalogue/gradient.js";
import type { PointCloudStyle } from "./catalogue/index.js";
import { toneOf } from "./catalogue/tone.js";
import { classTexture } from "./declaration/classes.js";
import { RGB } from "./declaration/colouring.js";
import type { FilteredNumbers } from "./declaration/filter.js";
import type { StyledAttribute } from "./declaration/option.js";
import { colouringsOf } from "./plan.js";

/** How points are coloured where no GPU does it: as a layer of this style. */
export interface PaintStyle {
  readonly style: PointCloudStyle;
  /** Of the data set, with their ranges. */
  readonly attributes: readonly StyledAttribute[];
  /** Bits per colour channel that the scan uses. Default: as the points tell. */
  readonly rgbBits?: 8 | 16 | undefined;
}

/** Numbers of the points that are coloured. */
export interface PaintedNumbers {
  /** Those of an attribute; undefined where points have no such attribute. */
  readonly numbersOf: (name: string) => Pick<FilteredNumbers, "value"> | undefined;
  /** Bits per colour channel that the scan uses. */
  readonly rgbBits: 8 | 16;
}

/** Writes the colour of a record, red, green and blue from 0 to 255, to `out`. */
export type PointPaint = (record: number, out: Uint8ClampedArray) => void;

/** Colour of points that a style says nothing of, such as levels of detail, which a complete cut has none of. */
const GREY = 70 / 255;

/** A colouring of points: red, green and blue from 0 to 1 into `out`. */
type Colour = (record: number, out: Float64Array) => void;

/**
 * What colours points as the shaders of a style do, in float64: colours of the scan, gradients, classes, tone, blends. For
 * pictures on paper, which have no shaders.
 */
export function pointPaint({ style, attributes }: PaintStyle, points: PaintedNumbers): PointPaint {
  const scene = { style, facts: { attributes } };
  const parts = colouringsOf(scene).map(({ effect, column, share }) => ({
    share,
    colour: colourOf(effect, column ?? "", scene, points),
  }));
  const [one, sum] = [new Float64Array(3), new Float64Array(3)];
  return (record, out) => {
    sum.fill(0);
    for (const { share, colour } of parts) {
      colour(record, one);
      for (let part = 0; part < 3; part++) sum[part] += share * one[part];
    }
    for (let part = 0; part < 3; part++) out[part] = 255 * sum[part];
  };
}

function colourOf(
  effect: string,
  column: string,
  scene: {
    readonly style: PointCloudStyle;
    readonly facts: { readonly attributes: readonly StyledAttribute[] };
  },
  { numbersOf, rgbBits }: PaintedNumbers,
): Colour {
  const { style } = scene;
  const [gamma, brightness, slope] = toneOf(style);
  const toned = (value: number) => clamped((value ** gamma + brightness - 0.5) * slope + 0.5);
  if (effect === RGB) {
    const channels = ["red", "green", "blue"].map((name) => numbersOf(name)?.value ?? (() => GREY * 255));
    const shift = rgbBits === 16 ? 8 : 0;
    return (record, out) => {
      for (let part = 0; part < 3; part++) out[part] = toned((channels[part](record) >> shift) / 255);
    };
  }
  const numbers = numbersOf(column);
  if (effect === "classification" && numbers) {
    const { data } = classTexture(style, undefined);
    return (record, out) => lookUp(data, Math.round(numbers.value(record)), 0, out);
  }
  if (effect !== "gradient" || !numbers) return (_, out) => out.fill(GREY);
  const [least, greatest] = rangeOf(column, scene);
  const width = greatest > least ? greatest - least : 1;
  const { data, width: texels } = styleGradient(style);
  return (record, out) => {
    const value = (numbers.value(record) - least) / width;
    // No value is the least of all, as on the GPU.
    const at = toned(clamped(Number.isNaN(value) ? 0 : value)) * (texels - 1);
    const lower = Math.min(Math.floor(at), texels - 2);
    lookUp(data, lower, at - lower, out);
  };
}

/** The colour of a texel, and a share of the next one. */
function lookUp(data: ArrayLike<number>, texel: number, share: number, out: Float64Array): void {
  for (let part = 0; part < 3; part++) {
    const [a, b] = [data[4 * texel + part], data[4 * texel + 4 + part] ?? 0];
    out[part] = (a + share * (b - a)) / 255;
  }
}

function clamped(value: number): number {
  return Math.min(1, Math.max(0, value));
}
