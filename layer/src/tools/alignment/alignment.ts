import { FormatError } from "../../errors/index.js";
import type { StationEquation } from "./station-equations.js";

/** A line for profiles and sections, in the plane of its file's coordinates. */
export interface Alignment {
  readonly name: string;
  /** x and y; arcs and clothoids as chords that are nowhere farther from them than 0.1 mm. */
  readonly vertices: readonly (readonly [number, number])[];
  /** True lengths of the stretches between the vertices, along arcs and clothoids. */
  readonly lengths: readonly number[];
  /** True directions at both ends of each stretch, as `Corridor` takes them; undefined for straight ones. */
  readonly headings: readonly (readonly [from: number, to: number] | undefined)[];
  /** Chainage of the first vertex. */
  readonly start: number;
  readonly equations: readonly StationEquation[];
  /** Metres in its unit of length; undefined where the file does not tell. */
  readonly unit: number | undefined;
}

/** What of an alignment has a unit of length. */
type MeasuredLine = Pick<Alignment, "vertices" | "start" | "equations" | "unit"> & {
  readonly lengths: readonly number[] | undefined;
};

/** Distance between a curve and the chords that stand for it, at most, in the unit of the file. */
export const TOLERANCE = 1e-4;

/** By how much the end of a curve may miss the one that the file gives, at most, in the unit of the file. */
export const CLOSURE = 0.01;

/**
 * An alignment in another unit of length: its places, its lengths, its stations and where they are counted anew.
 * @param unit metres in it; an alignment that names no unit is in it already
 */
export function inUnit<T extends MeasuredLine>(alignment: T, unit: number): T {
  const factor = (alignment.unit ?? unit) / unit;
  if (Math.abs(factor - 1) < 1e-12) return alignment;
  const { vertices, lengths, start, equations } = alignment;
  return {
    ...alignment,
    unit,
    vertices: vertices.map(([x, y]) => [x * factor, y * factor] as const),
    lengths: lengths?.map((length) => length * factor),
    start: start * factor,
    equations: equations.map((equation) => inFactor(equation, factor)),
  };
}

function inFactor({ internal, ahead, ...rest }: StationEquation, factor: number): StationEquation {
  return { ...rest, internal: internal * factor, ahead: ahead * factor };
}

/** An alignment that cannot be used. */
export function noAlignment(file: string, cause: string, fix: string): FormatError {
  return new FormatError({ code: "FORMAT_ALIGNMENT", file, cause, fix });
}

/**
 * The one of several lines that is wanted; one that cannot be named is no choice.
 * @param name undefined: there has to be one alone
 * @param without what to do where there is none at all
 * @throws FormatError FORMAT_ALIGNMENT
 */
export function theOne<T extends { readonly name: string }>(
  lines: readonly T[],
  name: string | undefined,
  file: string,
  without = "give a file with a polyline or an alignment",
): T {
  const found = name === undefined ? lines : lines.filter((line) => line.name === name);
  const [one, ...others] = found;
  if (one && others.length === 0) return one;
  const known = lines.map((line) => line.name);
  const single = known.filter((own) => known.indexOf(own) === known.lastIndexOf(own));
  const names = single.slice(0, 10).map((own) => `"${own}"`);
  const which = name === undefined ? "" : ` of the name "${name}"`;
  const cause = one ? `it has ${found.length} lines${which}` : `it has no line${which}`;
  if (lines.length === 0) throw noAlignment(file, cause, without);
  const choice =
    names.length > 0 ? `name one of ${names.join(", ")}` : "give each line a name, or a layer, of its own";
  throw noAlignment(file, cause, choice);
}
