import { instead, listed, shown } from "./words.js";

/** Where a value was given, and how it is refused. */
export interface Place<Context = unknown> {
  /** The option's name after those around it: `eyeDomeLighting.radius`. */
  readonly name: string;
  /** What values are held against. */
  readonly context: Context;
  /** @throws an error with this cause and fix. @param code Default: that of the option */
  refuse(cause: string, fix: string, code?: string): never;
}

/** What an option may be. */
export interface Kind<Value, Context = unknown> {
  /** What is valid, as it stands after "use". */
  readonly valid: string;
  /**
   * The whole value of what a caller gave, a copy of it where it is an object.
   * @param present the value that stands so far, which completes a part
   * @throws what {@link Place.refuse} throws
   */
  read(given: unknown, place: Place<Context>, present?: Value): Value;
}

/** Kinds of the properties of an object. */
export type Kinds<Value, Context = unknown> = {
  readonly [Key in keyof Value]-?: Kind<Value[Key], Context>;
};

/** A kind whose values are told by a test alone. */
export function kindOf<Value>(valid: string, holds: (given: unknown) => given is Value): Kind<Value> {
  return {
    valid,
    read: (given, place) => (holds(given) ? given : refuse(given, place, valid)),
  };
}

/** A number within bounds, both included; with one bound only, Infinity is one too. */
export function number(least: number, greatest = Number.POSITIVE_INFINITY): Kind<number> {
  return kindOf(
    `a number from ${least} ${greatest === Number.POSITIVE_INFINITY ? "on" : `to ${greatest}`}`,
    (given): given is number => typeof given === "number" && given >= least && given <= greatest,
  );
}

/** A finite number greater than another one. */
export function above(least: number): Kind<number> {
  return kindOf(
    `a number greater than ${least}`,
    (given): given is number =>
      typeof given === "number" && given > least && given < Number.POSITIVE_INFINITY,
  );
}

/** A whole number within bounds, both included. */
export function whole(least: number, greatest = Number.POSITIVE_INFINITY): Kind<number> {
  return kindOf(
    `a whole number from ${least} ${greatest === Number.POSITIVE_INFINITY ? "on" : `to ${greatest}`}`,
    (given): given is number =>
      Number.isInteger(given) && Number(given) >= least && Number(given) <= greatest,
  );
}

export const text: Kind<string> = kindOf("a string", (given): given is string => typeof given === "string");

export const flag: Kind<boolean> = kindOf(
  "true or false",
  (given): given is boolean => typeof given === "boolean",
);

/** One of a few values; a misspelt word is answered with the closest one. */
export function oneOf<const Value extends string | number | boolean>(
  ...values: readonly Value[]
): Kind<Value> {
  const words = values.map(String);
  return {
    valid: listed(words),
    read(given, place) {
      const found = values.find((value) => value === given);
      if (found !== undefined) return found;
      return place.refuse(`${place.name} cannot be ${shown(given)}`, instead(given, words));
    },
  };
}

/** Two numbers, the lesser one first; infinite ones are open ends where `least` is. */
export function interval({ empty }: { readonly empty: boolean }): Kind<readonly [number, number]> {
  const valid = `two numbers, ${empty ? "the second at least as great as" : "the second greater than"} the first`;
  return {
    valid,
    read(given, place) {
      const [least, greatest] = Array.isArray(given) && given.length === 2 ? given : [];
      const numbers = typeof least === "number" && typeof greatest === "number";
      if (numbers && (empty ? least <= greatest : Number.isFinite(greatest - least) && least < greatest)) {
        return [least, greatest];
      }
      const is = numbers ? `run from ${least} to ${greatest}` : `be ${shown(given)}`;
      return place.refuse(`${place.name} cannot ${is}`, `use ${valid}`);
    },
  };
}

/** An sRGB colour. */
export const colour: Kind<readonly [number, number, number]> = {
  valid: "three numbers from 0 to 1: red, green and blue",
  read(given, place) {
    const parts = Array.isArray(given) ? given : [];
    const holds =
      parts.length === 3 && parts.every((part) => typeof part === "number" && part >= 0 && part <= 1);
    return holds ? [parts[0], parts[1], parts[2]] : refuse(given, place, this.valid);
  },
};

/** An array of values of one kind. */
export function list<Value, Context>(of: Kind<Value, Context>): Kind<readonly Value[], Context> {
  const valid = `an array, each of it ${of.valid}`;
  return {
    valid,
    read(given, place) {
      if (!Array.isArray(given)) return refuse(given, place, valid);
      return Array.from(given, (item, at) => of.read(item, inside(place, `[${at}]`)));
    },
  };
}

/**
 * An object with some of the properties named. What is left out, or undefined, stays as it is; where nothing is yet,
 * it is as by default.
 */
export function parts<Value extends object, Context = unknown>(
  kinds: Kinds<Value, Context>,
  byDefault: Partial<Value> = {},
): Kind<Value, Context> {
  const names = Object.keys(kinds) as (keyof Value & string)[];
  const valid = `an object with ${listed(names)}`;
  return {
    valid,
    read(given, place, present) {
      const before: Partial<Value> = isObject(present) ? present : byDefault;
      const now = new Map(entriesOf(given, names, place, valid));
      const entries = names.map((name) => {
        const value = now.get(name);
        const there = before[name];
        if (value === undefined && there !== undefined) return [name, there];
        return [name, kinds[name].read(value, inside(place, `.${name}`), there)];
      });
      return Object.fromEntries(entries) as Value;
    },
  };
}

/** An object with some of the properties named, each checked; those left out, or undefined, stay out. */
export function some<Value extends object, Context = unknown>(
  kinds: Kinds<Value, Context>,
): Kind<Value, Context> {
  const names = Object.keys(kinds);
  const valid = `an object with ${listed(names)}`;
  return {
    valid,
    read(given, place) {
      const entries = entriesOf(given, names, place, valid)
        .filter(([, value]) => value !== undefined)
        .map(([name, value]) => [name, kinds[name as keyof Value].read(value, inside(place, `.${name}`))]);
      return Object.fromEntries(entries) as Value;
    },
  };
}

/** An object that has the methods named, its own or inherited, whoever made it. */
export function withMethods<Value extends object>(
  what: string,
  ...methods: readonly (keyof Value & string)[]
): Kind<Value> {
  return kindOf(
    what,
    (given): given is Value =>
      isObject(given) && methods.every((name) => typeof (given as Partial<Value>)[name] === "function"),
  );
}

/** What stops a call. */
export const signal: Kind<AbortSignal> = withMethods("an AbortSignal", "throwIfAborted", "addEventListener");

/** What is an object is of one kind, what is not of the other. */
export function either<Plain, Value extends object, Context = unknown>(
  plain: Kind<Plain, Context>,
  object: Kind<Value, Context>,
): Kind<Plain | Value, Context> {
  return {
    valid: `${plain.valid}, or ${object.valid}`,
    read(given, place, present) {
      if (!isObject(given) && !Array.isArray(given)) return plain.read(given, place);
      return object.read(
        given,
        place,
        isObject(present) || Array.isArray(present) ? (present as Value) : undefined,
      );
    },
  };
}

/**
 * The properties that an object has of its own.
 * @param names those that it may have; undefined: any
 * @throws what {@link Place.refuse} throws, where it is no object or has others
 */
export function entriesOf(
  given: unknown,
  names: readonly string[] | undefined,
  place: Place,
  valid: string,
): [string, unknown][] {
  if (!isObject(given)) return refuse(given, place, valid);
  const entries = Object.entries(given);
  for (const [name] of entries) {
    if (names && !names.includes(name)) {
      place.refuse(`${place.name} has no ${shown(name)}`, instead(name, names));
    }
  }
  return entries;
}

/** The place of what stands inside a value. */
export function inside<Context>(place: Place<Context>, step: string): Place<Context> {
  return { ...place, name: `${place.name}${step}` };
}

function refuse(given: unknown, place: Place, valid: string): never {
  return place.refuse(`${place.name} cannot be ${shown(given)}`, `use ${valid}`);
}

function isObject(value: unknown): value is object {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
