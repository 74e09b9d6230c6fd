import type { PointCloudStyle } from "./style.js";

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

/** Whether a class is shown: by the style's table and by the filter. */
export function showsClass(
  { classes }: Pick<PointCloudStyle, "classes">,
  filter: PointFilter | undefined,
  number: number,
): boolean {
  return classes[number]?.show !== false && (filter?.classes?.includes(number) ?? true);
}

/** Whether any class is hidden. */
export function hidesClasses(
  style: Pick<PointCloudStyle, "classes">,
  filter: PointFilter | undefined,
): boolean {
  if (filter?.classes) return true;
  return Object.values(style.classes).some(({ show }) => !show);
}

/** Bits of the kinds of return that a point is. */
function returnBits(number: number, of: number): number {
  const { first, last, intermediate, single } = RETURN_BITS;
  if (number <= 1) return number >= of ? first | last | single : first;
  return number >= of ? last : intermediate;
}

/**
 * Whether a record passes, on its exact values: what the GPU does in float32, for picks and exports.
 * @param attributes values by name, in their units; an attribute that a record has not got passes no range
 */
export function passesFilter(
  attributes: Readonly<Record<string, unknown>>,
  filter: PointFilter | undefined,
  style: Pick<PointCloudStyle, "classes">,
): boolean {
  const value = (name: string) => Number(attributes[name] ?? Number.NaN);
  if (hidesClasses(style, filter) && !showsClass(style, filter, value("classification"))) return false;
  if (filter?.returns) {
    const bits = returnBits(value("returnNumber"), value("numberOfReturns"));
    if (!filter.returns.some((kind) => (RETURN_BITS[kind] & bits) !== 0)) return false;
  }
  return Object.entries(filter?.ranges ?? {}).every(([name, [least, greatest]]) => {
    const at = value(name);
    return at >= least && at <= greatest;
  });
}
