import { frozen, instead, optionPlace, type Place, shown } from "../options/index.js";
import { EFFECTS, type PointCloudStyle } from "./catalogue/index.js";
import { COLOUR_OPTION } from "./declaration/colouring.js";
import { type Option, option, type StyleContext, type StyledCloud, wordFor } from "./declaration/option.js";

/** What may be given of a value: of an object any part of it, at any depth. */
type Given<Value> = Value extends readonly unknown[]
  ? Value
  : Value extends object
    ? { readonly [Key in keyof Value]?: Given<Value[Key]> | undefined }
    : Value;

/**
 * A style in parts. What is left out stays as it is, in objects within it too: `{ highlight: { share: 1 } }` keeps the
 * colour, `{ classes: { 6: { show: false } } }` all other classes.
 */
export type StyleParts = {
  readonly [Key in keyof PointCloudStyle]?: Given<PointCloudStyle[Key]> | undefined;
};

/** Words that effects declare, by the property of the style that they are given for. */
const WORDS: StyleContext["words"] = {
  color: wordsFor("color"),
  size: wordsFor("size"),
  shape: ["square", ...wordsFor("shape")],
};

function wordsFor(property: "color" | "size" | "shape"): string[] {
  return EFFECTS.flatMap(({ words }) => words?.[property] ?? []);
}

/** All properties of a style: those that groups of effects are chosen by, and those of each effect. */
export const STYLE_OPTIONS: ReadonlyMap<string, Option<unknown>> = new Map<string, Option<unknown>>([
  ["color", COLOUR_OPTION],
  ["size", option("STYLE_SIZE", wordFor("size"), "fixed")],
  ["shape", option("STYLE_SHAPE", wordFor("shape"), "square")],
  ...EFFECTS.flatMap(({ options }) => Object.entries<Option<unknown>>(options)),
]);

/** The style of a layer that was given none. */
export function defaultStyle(cloud: Pick<StyledCloud, "attributes">): PointCloudStyle {
  const context = contextOf(cloud);
  const entries = [...STYLE_OPTIONS].map(([name, { byDefault }]) => [name, byDefault(context)]);
  return frozen(Object.fromEntries(entries));
}

/**
 * A whole style of the parts given, the rest from `base`; frozen, as is all that it holds.
 * @throws StyleError STYLE_OPTION for a property that does not exist; for a value that is none of its property's:
 *   STYLE_COLOR, STYLE_NO_RGB, STYLE_BLEND, STYLE_GRADIENT, STYLE_RANGE, STYLE_TONE, STYLE_CLASSES, STYLE_SIZE,
 *   STYLE_POINT_SIZE, STYLE_SHAPE, STYLE_SPLATS, STYLE_EYE_DOME, STYLE_OPACITY, STYLE_HIGHLIGHT, STYLE_DITHERING
 */
export function completeStyle(given: StyleParts, base: PointCloudStyle, cloud: StyledCloud): PointCloudStyle {
  const context = contextOf(cloud);
  const at = (name: string, code: string): Place<StyleContext> => ({
    ...optionPlace(name, cloud.name, code),
    context,
  });
  const whole = at("a style", "STYLE_OPTION");
  if (typeof given !== "object" || given === null || Array.isArray(given)) {
    whole.refuse(`a style cannot be ${shown(given)}`, "use an object with the properties to be changed");
  }
  const style: Record<string, unknown> = { ...base };
  for (const [name, value] of Object.entries(given)) {
    const known = STYLE_OPTIONS.get(name);
    if (!known) whole.refuse(`a style has no ${shown(name)}`, instead(name, [...STYLE_OPTIONS.keys()]));
    else if (value !== undefined) style[name] = known.kind.read(value, at(name, known.code), style[name]);
    else if (known.mayBeUndefined) style[name] = undefined;
  }
  for (const [name, { agrees, code }] of STYLE_OPTIONS) agrees?.(style, at(name, code));
  return frozen(style as unknown as PointCloudStyle);
}

function contextOf({ attributes }: Pick<StyledCloud, "attributes">): StyleContext {
  return { attributes, words: WORDS };
}
