import type { Unit } from "./crs.js";
import { unknown } from "./refusal.js";

/** The metre (EPSG:9001). */
export const METRE: Unit = { name: "metre", kind: "linear", size: 1 };
/** International foot, exactly 0.3048 m (EPSG:9002). */
export const FOOT: Unit = { name: "foot", kind: "linear", size: 0.3048 };
/** US survey foot, exactly 1200/3937 m (EPSG:9003); 1.2 m apart from the international one at two million feet. */
const US_SURVEY_FOOT: Unit = { name: "US survey foot", kind: "linear", size: 1200 / 3937 };
/** The degree (EPSG:9102). */
export const DEGREE: Unit = { name: "degree", kind: "angular", size: Math.PI / 180 };
/** The radian (EPSG:9101). */
export const RADIAN: Unit = { name: "radian", kind: "angular", size: 1 };
/** The grad or gon, 400 to a turn (EPSG:9105). */
export const GRAD: Unit = { name: "grad", kind: "angular", size: Math.PI / 200 };

/** EPSG unit codes as they stand in GeoTIFF keys and in WKT. */
const BY_CODE: ReadonlyMap<number, Unit> = new Map([
  [9001, METRE],
  [9002, FOOT],
  [9003, US_SURVEY_FOOT],
  [9005, { name: "Clarke's foot", kind: "linear", size: 0.3047972654 }],
  [9036, { name: "kilometre", kind: "linear", size: 1000 }],
  [9037, { name: "Clarke's yard", kind: "linear", size: 0.9143917962 }],
  [9042, { name: "British chain (Sears 1922)", kind: "linear", size: 20.1167651215526 }],
  [9084, { name: "Indian yard", kind: "linear", size: 0.91439853 }],
  [9096, { name: "yard", kind: "linear", size: 0.9144 }],
  [9101, RADIAN],
  [9102, DEGREE],
  [9103, { name: "arc-minute", kind: "angular", size: Math.PI / 10800 }],
  [9104, { name: "arc-second", kind: "angular", size: Math.PI / 648000 }],
  [9105, GRAD],
  [9106, GRAD],
  [9122, DEGREE],
]);

/** Units of `+units=` that PROJ and proj4js both know (PROJ, units.cpp). */
const BY_PROJ_NAME: ReadonlyMap<string, Unit> = new Map([
  ["m", METRE],
  ["ft", FOOT],
  ["us-ft", US_SURVEY_FOOT],
  ["km", { name: "kilometre", kind: "linear", size: 1000 }],
  ["cm", { name: "centimetre", kind: "linear", size: 0.01 }],
  ["mm", { name: "millimetre", kind: "linear", size: 0.001 }],
  ["yd", { name: "yard", kind: "linear", size: 0.9144 }],
]);

/** A unit by its EPSG code. */
export function unitByCode(code: number): Unit | undefined {
  return BY_CODE.get(code);
}

/** A unit by its name in PROJ strings (`us-ft`). */
export function unitByProjName(name: string): Unit | undefined {
  return BY_PROJ_NAME.get(name);
}

/**
 * Unit from a definition. Sizes are written with 7 to 15 digits; one within 1e-8 of a unit known here is that unit
 * (the two feet are 2e-6 apart), so that rounding of the writer does not move a point.
 *
 * @param size metres or radians
 * @throws Refusal CRS_UNKNOWN when that is not between a nanometre and a light second: no unit of a scan
 */
export function unitOf(name: string, kind: Unit["kind"], size: number): Unit {
  if (!(size > 1e-9 && size < 3e8))
    throw unknown(`the unit "${name}" has no size that can be meant: ${size}`);
  for (const known of [METRE, FOOT, US_SURVEY_FOOT, DEGREE, GRAD, RADIAN]) {
    if (known.kind === kind && Math.abs(size / known.size - 1) < 1e-8) return known;
  }
  return { name, kind, size };
}

/** A unit of heights, or, with a negative size, of depths, which count downwards. */
export function directed(unit: Unit, down: boolean): Unit {
  const size = Math.abs(unit.size);
  return { ...unit, size: down ? -size : size };
}

/** The unit as PROJ writes it: `+units=us-ft`, else `+to_meter=`. */
export function projUnit(unit: Unit): string {
  for (const [name, known] of BY_PROJ_NAME) {
    if (known.size === unit.size) return `+units=${name}`;
  }
  return `+to_meter=${unit.size}`;
}
