import { closest, type Kind, listed, shown } from "../../options/index.js";
import type { Colouring, Effect, PartContext, Scene } from "./effect.js";
import type { Option, StyleContext } from "./option.js";

/** Share of colour below which a blend shows nothing: half a step of 8 bits. */
export const LEAST_SHARE = 0.5 / 255;

/** The scan's own colours: their attribute, their column, and the colouring by them. */
export const RGB = "rgb";

/** What points of a profile are coloured by that show how far they lie from its line, metres, left positive. */
export const OFFSET = "offset from the line";

/** The part of a style that says where colours come from. */
export interface ColourStyle {
  readonly color: string;
}

/** What a point's colour may show: a word of an effect, or an attribute's name. */
export const colourBy: Kind<string, StyleContext> = {
  valid: "the name of an attribute",
  read(given, place) {
    const valid = colourings(place.context);
    if (typeof given === "string" && valid.includes(given)) return given;
    if (given === RGB) {
      const fix = `use ${listed(valid)}`;
      return place.refuse("the scan has no colours of its own", fix, "STYLE_NO_RGB");
    }
    const near = typeof given === "string" ? closest(given, valid) : undefined;
    return place.refuse(
      `${place.name} cannot be ${shown(given)}`,
      `${near ? `did you mean "${near}"? Otherwise ` : ""}use ${listed(valid)}`,
    );
  },
};

/** All that a data set can be coloured by. */
function colourings({ attributes, words }: StyleContext): string[] {
  const single = attributes.filter(({ components = 1, kind }) => kind === "color" || components === 1);
  const names = single.map(({ name }) => name);
  return [...names, ...words.color.filter((word) => word !== RGB && !names.includes(word))];
}

/** Where colours come from: the scan's own where it has some, else heights. */
export const COLOUR_OPTION: Option<string> = {
  code: "STYLE_COLOR",
  kind: colourBy,
  byDefault: ({ attributes }) => (attributes.some(({ name }) => name === RGB) ? RGB : "elevation"),
};

/** Share of the colour that comes from colourings of a kind. */
export function shareOf(
  { colourings }: Pick<Scene<unknown>, "colourings">,
  which: (colouring: Colouring) => boolean,
): number {
  return colourings.reduce((sum, colouring) => sum + (which(colouring) ? colouring.share : 0), 0);
}

/** What the effects have in common that colour points. @param shows what they show, as the ledger's words have it */
export function colouringEffect<const Name extends string>(name: Name, shows: string) {
  const share = (scene: Pick<Scene<unknown>, "colourings">) =>
    shareOf(scene, ({ effect }) => effect === name);
  return {
    name,
    group: "colours",
    forcible: "never",
    unit: "share",
    threshold: LEAST_SHARE,
    source: "share of a point's colour (thesis, 4.1)",
    wish: (scene: Pick<Scene<unknown>, "colourings">) =>
      share(scene) > 0
        ? ({ kind: "asked", why: `the style shows ${shows}` } as const)
        : ({ kind: "off", why: `the style does not show ${shows}` } as const),
    magnitude: share,
  } as const satisfies Partial<Effect<{ name: Name }>>;
}

/** The colourings of one effect, each with its place among all. */
export function colouringsOf(
  { colourings }: Pick<PartContext<unknown>, "colourings">,
  { name }: { readonly name: string },
): { readonly column: string; readonly index: number }[] {
  return colourings
    .map(({ effect, column }, index) => ({ effect, column: column ?? "", index }))
    .filter(({ effect }) => effect === name);
}

/** Statements that give each colouring of an effect its colour, by an expression. */
export function colourStatements(
  context: Pick<PartContext<unknown>, "colourings">,
  effect: { readonly name: string },
  expression: (column: string, index: number) => string,
): string {
  const single = context.colourings.length === 1;
  return colouringsOf(context, effect)
    .map(({ column, index }) => `vec3 color${single ? "" : index} = ${expression(column, index)};`)
    .join("\n");
}
