import {
  entriesOf,
  frozen,
  inside,
  interval,
  type Kind,
  list,
  oneOf,
  optionPlace,
  type Place,
  some,
  whole,
} from "../../options/index.js";
import { type ClassStyle, hidesClasses, showsClass } from "./classes.js";
import type { StyledCloud } from "./option.js";

/** Which returns of a pulse: `single` is first and last of one, `intermediate` neither. */
export type ReturnKind = "first" | "last" | "intermediate" | "single";

/** Which points are shown, picked and exported; what is left out lets all pass. */
export interface PointFilter {
  /** Numbers of the classes that pass. */
  readonly classes?: readonly number[] | undefined;
  /** Kinds of returns that pass; a point of several kinds passes by any. */
  readonly returns?: readonly ReturnKind[] | undefined;
  /** Least and greatest value that passes, both included, in the attribute's unit, by the attribute's name. */
  readonly ranges?: Readonly<Record<string, readonly [number, number]>> | undefined;
}

/** A kind of return as a bit; a first and only return is `first`, `last` and `single`. */
export const RETURN_BITS: Readonly<Record<ReturnKind, number>> = {
  first: 1,
  last: 2,
  intermediate: 4,
  single: 8,
};

/** Bits of the kinds of return that a point is. */
function returnBits(number: number, of: number): number {
  const { first, last, intermediate, single } = RETURN_BITS;
  if (number <= 1) return number >= of ? first | last | single : first;
  return number >= of ? last : intermediate;
}

/** Whether a return is of one of some kinds. */
function isOfReturns(kinds: readonly ReturnKind[], number: number, of: number): boolean {
  const bits = returnBits(number, of);
  return kinds.some((kind) => (RETURN_BITS[kind] & bits) !== 0);
}

/** Numbers of an attribute that are held against a filter. */
export interface FilteredNumbers {
  /** By the index of a record, in the attribute's unit; NaN where it has none. */
  readonly value: (record: number) => number;
  /** What stored integers are multiplied by; 0 of numbers that are stored as they are. */
  readonly step: number;
}

/** Share of a step by which a value may lie beyond a bound: what float64 makes of `integer · step + offset` decides nothing. */
const SLACK = 1e-6;

/**
 * What tells whether records pass, on their exact values: what the GPU does in float32, for exports and for what is pointed at.
 * @param style whose hidden classes do not pass. Default: none is hidden
 * @param numbersOf undefined where records have no such attribute, which then passes no range
 */
export function recordTest(
  filter: PointFilter | undefined,
  style: ClassStyle | undefined,
  numbersOf: (name: string) => FilteredNumbers | undefined,
): (record: number) => boolean {
  const { classes, returns, ranges = {} } = filter ?? {};
  const tests: ((record: number) => boolean)[] = [];
  const numberOf = (name: string) => numbersOf(name)?.value ?? (() => Number.NaN);
  if (style ? hidesClasses(style, filter) : classes) {
    const value = numberOf("classification");
    const passing = new Set(classes);
    tests.push((record) => (style ? showsClass(style, filter, value(record)) : passing.has(value(record))));
  }
  if (returns) {
    const [number, of] = [numberOf("returnNumber"), numberOf("numberOfReturns")];
    tests.push((record) => isOfReturns(returns, number(record), of(record)));
  }
  for (const [name, [least, greatest]] of Object.entries(ranges)) {
    const { value, step } = numbersOf(name) ?? { value: () => Number.NaN, step: 0 };
    const slack = SLACK * Math.abs(step);
    tests.push((record) => {
      const at = value(record);
      return at >= least - slack && at <= greatest + slack;
    });
  }
  return (record) => tests.every((test) => test(record));
}

/**
 * A filter that can be carried out on a data set, frozen.
 * @throws StyleError STYLE_FILTER
 */
export function checkFilter(filter: PointFilter, { attributes, name: file }: StyledCloud): PointFilter {
  const place: Place = optionPlace("filter", file, "STYLE_FILTER");
  const single = attributes.filter(({ kind, components = 1 }) => kind !== "color" && components === 1);
  const names = single.map(({ name }) => name);
  const kinds = { classes: CLASSES, returns: RETURNS, ranges: rangesOf(names) };
  return frozen(some<PointFilter>(kinds).read(filter, place));
}

const CLASSES = list(whole(0, 255));
const RETURNS = list(oneOf("first", "last", "intermediate", "single"));

/** Ranges of attributes by name. */
function rangesOf(names: readonly string[]): Kind<NonNullable<PointFilter["ranges"]>> {
  const valid = "an object of [least, greatest] by attribute";
  const range = interval({ empty: true });
  return {
    valid,
    read: (given, place) => {
      const entries = entriesOf(given, names, place, valid).filter(([, value]) => value !== undefined);
      return Object.fromEntries(
        entries.map(([name, value]) => [name, range.read(value, inside(place, `.${name}`))]),
      );
    },
  };
}
