import type { Crs, StatedAccuracy } from "@groma/georef";

/** A fact and, where there is one, a remark to it. */
export interface Words {
  readonly text: string;
  readonly note?: string;
}

const whole = new Intl.NumberFormat("en", { maximumFractionDigits: 0 });
/** A bound is never rounded down. */
const bound = new Intl.NumberFormat("en", { maximumSignificantDigits: 2, roundingMode: "ceil" });

/** A count of points or nodes: `10,653,336`. */
export function countWords(count: number): string {
  return whole.format(count);
}

/** `1 point`, `2 points`. */
export function counted(count: number, noun: string): string {
  return `${countWords(count)} ${noun}${count === 1 ? "" : "s"}`;
}

/** A bound in the unit that suits it, two digits, rounded up: `0.87 mm`, `4.2 cm`, `1.3 m`. */
export function lengthWords(metres: number | null): string {
  if (metres === null || !Number.isFinite(metres)) return "not known";
  // Twelve digits take off what binary fractions add, which rounding up would carry into the last digit shown.
  const shown = (value: number) => bound.format(Number(value.toPrecision(12)));
  if (metres < 0.01) return `${shown(metres * 1000)} mm`;
  if (metres < 1) return `${shown(metres * 100)} cm`;
  return `${shown(metres)} m`;
}

/**
 * Name of a coordinate system, and its code.
 * @param given whether the reader gave it, in place of what the file says
 */
export function crsWords({ name, code }: Pick<Crs, "name" | "code">, { given }: { given: boolean }): Words {
  return { text: name, note: `${code ?? "no code named"}${given ? "; given by you, not by the file" : ""}` };
}

/**
 * What heights are measured from, and how they are drawn.
 * @param applied whether the geoid of the heights takes part in the placing
 */
export function heightWords(
  { height, verticalUnit }: Pick<Crs, "height" | "verticalUnit">,
  { applied }: { applied: boolean },
): Words {
  const unit = verticalUnit.declared ? "" : `; unit not declared, taken as ${verticalUnit.name}`;
  if (height.kind === "ellipsoidal")
    return { text: "above the ellipsoid", ...(unit && { note: unit.slice(2) }) };
  if (height.kind === "unknown") return { text: "unknown", note: `drawn as ellipsoidal${unit}` };
  const code = height.epsg === undefined ? "" : ` (EPSG:${height.epsg})`;
  const drawn = applied ? "its geoid is applied" : "its geoid is not applied, drawn as ellipsoidal";
  return { text: `above the geoid: ${height.model}${code}`, note: `${drawn}${unit}` };
}

/** The sum of an accuracy's parts, or what of it is known. */
export function accuracyWords({ total, parts }: StatedAccuracy): Words {
  if (total !== null) return { text: lengthWords(total), note: "sum of the parts" };
  const known = parts.reduce((sum, { metres }) => sum + (metres ?? 0), 0);
  const missing = parts.filter(({ metres }) => metres === null).map(({ name }) => name);
  return { text: "not known", note: `${lengthWords(known)} without ${missing.join(" and ")}` };
}
