import { FormatError } from "../../errors/index.js";
import type { StationEquation } from "./station-equations.js";

/** A line for profiles and sections, in the plane of its file's coordinates. */
export interface Alignment {
  readonly name: string;
  /** x and y; arcs and clothoids as chords that are nowhere farther from them than 0.1 mm. */
  readonly vertices: readonly (readonly [number, number])[];
  /** True lengths of the stretches between the vertices, along arcs and clothoids. */
  readonly lengths: readonly number[];
  /** Chainage of the first vertex. */
  readonly start: number;
  readonly equations: readonly StationEquation[];
  /** Metres in its unit of length; undefined where the file does not tell. */
  readonly unit: number | undefined;
}

/** Distance between a curve and the chords that stand for it, at most, in the unit of the file. */
export const TOLERANCE = 1e-4;

/** By how much the end of a curve may miss the one that the file gives, at most, in the unit of the file. */
export const CLOSURE = 0.01;

/** An alignment that cannot be used. */
export function noAlignment(file: string, cause: string, fix: string): FormatError {
  return new FormatError({ code: "FORMAT_ALIGNMENT", file, cause, fix });
}

/**
 * The one of several lines that is wanted.
 * @param name undefined: there has to be one alone
 * @throws FormatError FORMAT_ALIGNMENT
 */
export function theOne<T extends { readonly name: string }>(
  lines: readonly T[],
  name: string | undefined,
  file: string,
): T {
  const found = name === undefined ? lines : lines.filter((line) => line.name === name);
  const [one, ...others] = found;
  if (one && others.length === 0) return one;
  const names = [...new Set(lines.map((line) => `"${line.name}"`))].slice(0, 10).join(", ");
  const which = name === undefined ? "" : ` of the name "${name}"`;
  const cause = one ? `it has ${found.length} lines${which}` : `it has no line${which}`;
  throw noAlignment(
    file,
    cause,
    lines.length > 0 ? `name one of ${names}` : "give a file with a polyline or an alignment",
  );
}
