import { colour, either, interval, type Kind, list, number, oneOf, parts } from "../../options/index.js";
import {
  type ColourStyle,
  colouringEffect,
  colouringsOf,
  colourStatements,
} from "../declaration/colouring.js";
import { type Effect, showsColour } from "../declaration/effect.js";
import type { ColumnScale, SceneFacts } from "../declaration/facts.js";
import {
  GRADIENT_COLOUR,
  GRADIENT_NAMES,
  type GradientName,
  type GradientStop,
  gradientTexture,
} from "../declaration/gradients.js";
import { option, optional } from "../declaration/option.js";
import { tone } from "./tone.js";

/** Which colours values have. */
export interface GradientStyle {
  /** Colours of scalar attributes. Default: `auto`, which is greyscale for intensity and viridis for all others. */
  readonly gradient: "auto" | GradientName | readonly GradientStop[];
  /** Values at the ends of the gradient, in the attribute's unit. Default: what the data set's statistics say. */
  readonly range: readonly [number, number] | undefined;
}

const stop = parts<GradientStop>({ at: number(0, 1), color: colour });

/** Two stops or more, at places that do not fall. */
const stops: Kind<readonly GradientStop[]> = {
  valid: "two stops or more, { at, color }, at rising places from 0 to 1",
  read(given, place) {
    const all = list(stop).read(given, place);
    const rising = all.every(({ at }, index) => index === 0 || at >= all[index - 1].at);
    if (all.length >= 2 && rising) return all;
    return place.refuse(`the stops of ${place.name} do not form a gradient`, `use ${this.valid}`);
  },
};

/** Scalar attributes through a gradient (thesis, 4.1). */
export const gradient: Effect<{ name: "gradient"; own: GradientStyle; reads: ColourStyle }> = {
  ...colouringEffect("gradient", "a scalar attribute"),
  options: {
    gradient: option("STYLE_GRADIENT", either(oneOf("auto", ...GRADIENT_NAMES), stops), "auto"),
    range: optional("STYLE_RANGE", interval({ empty: false })),
  },
  colours: { shows: (_, kind) => kind === "scalar" || kind === "flags", toned: true, smooth: true },
  part(context) {
    if (!showsColour(context.pass)) return undefined;
    const scalars = colouringsOf(context, gradient);
    const toned = context.runs(tone);
    return {
      attributes: scalars.map(({ column }) => ({ column, components: 1, normalized: false })),
      uniforms: [
        ...scalars.map(({ index }) => ({ name: `u_value${index}`, type: "vec2", scope: "node" }) as const),
        { name: "u_gradient", type: "sampler2D", scope: "texture" },
      ],
      vertexFunctions: [GRADIENT_COLOUR],
      vertex: {
        color: colourStatements(context, gradient, (column, index) => {
          const value = `${context.attribute(column)} * u_value${index}.x + u_value${index}.y`;
          return `gradientColor(${toned ? `tone(clamp(${value}, 0.0, 1.0))` : value})`;
        }),
      },
    };
  },
  nodeValues: (scene, { columns }) =>
    Object.fromEntries(
      colouringsOf(scene, gradient).map(({ column, index }) => [
        `u_value${index}`,
        valueMap(columns.get(column), rangeOf(column, scene)),
      ]),
    ),
  textures: ({ style }) => [styleGradient(style)],
};

/** The gradient that a style shows its first colouring with. */
export function styleGradient({ gradient, color }: GradientStyle & ColourStyle) {
  if (gradient !== "auto") return gradientTexture(gradient);
  return gradientTexture(color === "intensity" ? "greyscale" : "viridis");
}

/** Values at the ends of the gradient for an attribute: the style's, else the data set's, else those of 16 bits. */
export function rangeOf(
  name: string,
  {
    style,
    facts,
  }: { readonly style: GradientStyle & ColourStyle; readonly facts: Pick<SceneFacts, "attributes"> },
): readonly [number, number] {
  // A range is given in the unit of the first colouring.
  if (style.range && name === style.color) return style.range;
  return facts.attributes.find((attribute) => attribute.name === name)?.range ?? [0, 65535];
}

/** Factor and summand that take stored numbers to 0 … 1 over a range; formed in float64. */
function valueMap(column: ColumnScale | undefined, [least, greatest]: readonly [number, number]): number[] {
  const width = greatest > least ? greatest - least : 1;
  if (!column) return [0, 0];
  if (column.constant) return [0, (column.constant[0] - least) / width];
  return [column.scale / width, (column.offset - least) / width];
}
