import { type Kind, oneOf, type Place } from "../../options/index.js";

/** What the values of an attribute are: colours, numbers, class numbers or bits. */
export type AttributeKind = "color" | "scalar" | "class" | "flags";

/** What is known of an attribute of a data set: as much as colouring needs. */
export interface StyledAttribute {
  /** Name of the column; the scan's own colours are `rgb`. */
  readonly name: string;
  readonly kind: AttributeKind;
  /** Numbers per point. Default: 1. */
  readonly components?: number;
  /** Least and greatest value; undefined while not known. */
  readonly range?: readonly [number, number] | undefined;
}

/** Whose style it is; a `PointCloud` is one. */
export interface StyledCloud {
  readonly attributes: readonly StyledAttribute[];
  /** Name of the file, for errors. */
  readonly name: string;
}

/** What a style is checked against. */
export interface StyleContext {
  /** Attributes of the data set. */
  readonly attributes: readonly StyledAttribute[];
  /** Words of effects, by the property that they are given for. */
  readonly words: Readonly<Record<"color" | "size" | "shape", readonly string[]>>;
}

/** One property of a style. */
export interface Option<Value> {
  /** Code of the error where a value is none of its kind. */
  readonly code: `STYLE_${string}`;
  readonly kind: Kind<Exclude<Value, undefined>, StyleContext>;
  /** Its value in the style of a layer that was given none. */
  byDefault(context: StyleContext): Value;
  /** Whether `undefined` is a value of it; of others, it leaves the present one. */
  readonly mayBeUndefined?: boolean;
  /** Throws by `place.refuse` where it does not go together with the rest of the style. */
  agrees?(style: Readonly<Record<string, unknown>>, place: Place<StyleContext>): void;
}

/** An option whose default is the same for all data sets. */
export function option<Value>(
  code: Option<Value>["code"],
  kind: Kind<Value, StyleContext>,
  byDefault: NoInfer<Value>,
  rest: Pick<Option<Value>, "agrees"> = {},
): Option<Value> {
  return { code, kind: kind as Option<Value>["kind"], byDefault: () => byDefault, ...rest };
}

/** An option that may be undefined, and is by default. */
export function optional<Value>(
  code: Option<Value>["code"],
  kind: Kind<Value, StyleContext>,
): Option<Value | undefined> {
  return {
    code,
    kind: kind as Option<Value | undefined>["kind"],
    byDefault: () => undefined,
    mayBeUndefined: true,
  };
}

/** One of the words that effects declare for a property. */
export function wordFor(property: "size" | "shape"): Kind<string, StyleContext> {
  return {
    valid: `a word for ${property}`,
    read: (given, place) => oneOf(...place.context.words[property]).read(given, place),
  };
}

/** On, off, or where the scene calls for it. */
export const onOffOrAuto: Kind<boolean | "auto"> = oneOf<boolean | "auto">(true, false, "auto");
