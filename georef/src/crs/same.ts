import { requireFields } from "../errors/arguments.js";
import type { Crs } from "./crs.js";

/** Relative difference of two numbers that writers of CRS texts mean as one: they round at the twelfth digit or later. */
const ROUNDED = 1e-10;
/** The same for units: the US survey foot is 0.3048006 m in many files, 1200/3937 m by definition. */
const ROUNDED_UNIT = 1e-7;
const SHIFT = "+towgs84";

/**
 * Whether two coordinate reference systems mean the same places in plane, however they are spelled: the same
 * projection, ellipsoid, meridian and unit by their numbers, and the same datum. Equal EPSG codes stand for one datum
 * even where one text names an older shift to WGS 84.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function samePlane(a: Crs, b: Crs): boolean {
  requireFields(b, { proj4: "text", horizontalUnit: "object" }, "samePlane: b");
  requireFields(a, { proj4: "text", horizontalUnit: "object" }, "samePlane: a");
  if (a.horizontalUnit.kind !== b.horizontalUnit.kind) return false;
  if (!sameSize(a.horizontalUnit.size, b.horizontalUnit.size)) return false;
  const [first, second] = [parametersOf(a.proj4), parametersOf(b.proj4)];
  const keys = new Set([...first.keys(), ...second.keys()]);
  keys.delete(SHIFT);
  for (const key of keys) if (!sameValue(first.get(key), second.get(key))) return false;
  const [codeA, codeB] = [planeCode(a), planeCode(b)];
  if (codeA !== undefined && codeA === codeB) return true;
  if (!sameValue(first.get(SHIFT), second.get(SHIFT))) return false;
  return !a.datum || !b.datum || a.datum.operation === b.datum.operation;
}

/**
 * Whether two systems measure heights from the same zero in the same unit. Unknown heights equal unknown ones.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function sameHeights(a: Crs, b: Crs): boolean {
  requireFields(b, { verticalUnit: "object", height: "object" }, "sameHeights: b");
  requireFields(a, { verticalUnit: "object", height: "object" }, "sameHeights: a");
  return (
    sameSize(a.verticalUnit.size, b.verticalUnit.size) &&
    sameZero(a.height, b.height) &&
    isAboveOwnEllipsoid(a) === isAboveOwnEllipsoid(b)
  );
}

/** Whether a PROJ string of {@link Crs} shifts its datum. */
export function isShifted(proj4: string): boolean {
  return /\+towgs84=\S*[1-9]/.test(proj4);
}

/** Whether heights are above the ellipsoid of the CRS's own datum, and so move with its shift. */
export function isAboveOwnEllipsoid({ height }: Pick<Crs, "height">): boolean {
  return height.kind === "ellipsoidal" && height.ellipsoid === "own";
}

/** Whether two height references are one: by their EPSG codes, else by their names. */
export function sameZero(a: Crs["height"], b: Crs["height"]): boolean {
  if (a.kind !== "geoid" || b.kind !== "geoid") return a.kind === b.kind;
  if (a.epsg !== undefined && b.epsg !== undefined) return a.epsg === b.epsg;
  return plain(a.model) === plain(b.model);
}

/** Whether two sizes of units are one but for rounding. */
export function sameSize(a: number, b: number): boolean {
  return Math.abs(a - b) <= ROUNDED_UNIT * Math.abs(b);
}

/** Code of the horizontal part: `2056` of `EPSG:2056+5728`. */
function planeCode({ code }: Crs): string | undefined {
  return /^EPSG:(\d+)/.exec(code ?? "")?.[1];
}

/** The parameters that say something of places. Units are compared by their size, wherever they stand. */
function parametersOf(proj4: string): Map<string, string> {
  const silent = new Set(["+no_defs", "+type", "+units", "+to_meter", ""]);
  const pairs = proj4.split(/\s+/).map((word): [string, string] => {
    const equals = word.indexOf("=");
    return equals < 0 ? [word, ""] : [word.slice(0, equals), word.slice(equals + 1)];
  });
  return new Map(pairs.filter(([key]) => !silent.has(key)));
}

function sameValue(a: string | undefined, b: string | undefined): boolean {
  if (a === b) return true;
  if (a === undefined || b === undefined) return false;
  // A shift of three numbers has no rotations: seven with zeros mean the same.
  const [first, second] = [a.split(","), b.split(",")];
  const longer = first.length > second.length ? first : second;
  return longer.every((_, i) => {
    const [one, other] = [first[i] ?? "0", second[i] ?? "0"];
    return one === other || sameNumber(Number(one), Number(other));
  });
}

/** Both near zero, or equal but for the last digits. */
function sameNumber(a: number, b: number): boolean {
  return Math.abs(a - b) <= ROUNDED * Math.max(Math.abs(a), Math.abs(b), 1e-2);
}

function plain(name: string): string {
  return name.toLowerCase().replace(/[^a-z0-9]/g, "");
}
