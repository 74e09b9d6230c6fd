import type { Crs, DatumOperation, EpsgLookup, HeightReference } from "./crs.js";
import { findDatumShift, translation } from "./datum-table.js";
import { type Figure, isGeocentricFigure } from "./ellipsoids.js";
import { projectionOf } from "./methods.js";
import type { CrsModel, HorizontalModel, VerticalModel } from "./model.js";
import { NO_DATUM, readProjString, shiftOfProjString } from "./proj-string.js";
import { unsupported } from "./refusal.js";
import { isShifted } from "./same.js";
import { shiftAccuracy } from "./shift-worth.js";
import { METRE, projUnit } from "./units.js";
import { WEB_MERCATOR } from "./web-mercator.js";

/** A datum shift with what is known about it; no `towgs84` means coordinates are taken as WGS 84. */
interface Shift {
  readonly towgs84?: readonly number[] | undefined;
  readonly datum: DatumOperation;
}

/**
 * What `Crs` says of the model, with the horizontal part as one PROJ string that leaves proj4js nothing to
 * guess: `+a` and `+rf` in place of a name, the shift always explicit, no axis order, no vertical part.
 * @throws Refusal CRS_UNSUPPORTED
 */
export function normalise(model: CrsModel, lookup?: EpsgLookup): Omit<Crs, "wkt"> {
  const { horizontal, vertical } = model;
  if (horizontal.projString) {
    const own = normalise(readProjString(horizontal.projString), lookup);
    return { ...own, ...identity(model), ...heightsThere(own.proj4, horizontal, vertical) };
  }
  const shift = findShift(horizontal, lookup);
  const words = [
    projection(horizontal),
    ...meridian(horizontal),
    ...shiftText(shift),
    ...unitText(horizontal),
    "+no_defs",
  ];
  const proj4 = words.join(" ");
  return {
    ...identity(model),
    proj4,
    horizontalUnit: horizontal.unit,
    ...heightsThere(proj4, horizontal, vertical),
    datum: shift.datum,
  };
}

/**
 * The heights of a plane: where its datum is not shifted, its ellipsoid is as good as that of WGS 84. Where it is, PROJ takes
 * heights above it whatever datum the text names for them.
 */
function heightsThere(
  proj4: string,
  horizontal: HorizontalModel,
  vertical: VerticalModel | undefined,
): Pick<Crs, "verticalUnit" | "height"> {
  const { verticalUnit, height } = heights(horizontal, vertical);
  if (height.kind !== "ellipsoidal") return { verticalUnit, height };
  if (!isShifted(proj4)) {
    const { ellipsoid: _, ...same } = height;
    return { verticalUnit, height: same };
  }
  const [own, other] = [horizontal.datum.name, vertical?.datum];
  if (other === undefined || other === own || height.doubt !== undefined) return { verticalUnit, height };
  const doubt = `declared above the ellipsoid of ${other}, and taken as above that of ${own}, as PROJ does`;
  return { verticalUnit, height: { ...height, doubt } };
}

/** Heights without a code take nothing from what is known of the plane: its code stays. */
function identity({ name, code, horizontal, vertical }: CrsModel): Pick<Crs, "name" | "code"> {
  const plane = horizontal.code;
  if (plane !== undefined && vertical?.code !== undefined) {
    return { name, code: `EPSG:${plane}+${vertical.code}` };
  }
  const known = vertical ? (code ?? plane) : (plane ?? code);
  return known === undefined ? { name } : { name, code: `EPSG:${known}` };
}

/** Unit and reference of z: what is declared, else the horizontal linear unit and "unknown". */
export function heights(
  horizontal: Pick<HorizontalModel, "unit" | "heightUnit" | "kind">,
  vertical: VerticalModel | undefined,
): Pick<Crs, "verticalUnit" | "height"> {
  const fallback = horizontal.unit.kind === "linear" ? horizontal.unit : METRE;
  const declared = vertical?.unit ?? horizontal.heightUnit;
  const verticalUnit = { ...(declared ?? fallback), declared: declared !== undefined };
  return { verticalUnit, height: heightReference(horizontal, vertical) };
}

function heightReference(
  horizontal: Pick<HorizontalModel, "heightUnit" | "kind">,
  vertical: VerticalModel | undefined,
): HeightReference {
  if (!vertical) {
    const threeDimensional = horizontal.heightUnit !== undefined || horizontal.kind === "geocentric";
    return threeDimensional ? { kind: "ellipsoidal", ellipsoid: "own" } : { kind: "unknown" };
  }
  const { reference, name: model, code: epsg, ellipsoid, doubt } = vertical;
  const doubted = doubt === undefined ? {} : { doubt };
  if (reference === "ellipsoidal") return { kind: reference, ...(ellipsoid && { ellipsoid }), ...doubted };
  // Nothing is known of heights that are to be taken as they are.
  if (reference === "unknown" || isNullGrid(model)) return { kind: "unknown" };
  return { kind: reference, model, ...(epsg !== undefined && { epsg }), ...doubted };
}

function projection(model: HorizontalModel): string {
  if (model.kind === "geocentric") {
    if (!isGeocentricFigure(model.datum.figure)) {
      throw unsupported(`geocentric coordinates of the datum "${model.datum.name}" are not supported`);
    }
    return `+proj=geocent ${figureText(model.datum.figure)}`;
  }
  if (model.kind === "geographic") return `+proj=longlat ${figureText(model.datum.figure)}`;
  const text = projectionOf(model);
  return text === WEB_MERCATOR
    ? `${text} +a=6378137 +b=6378137 +nadgrids=@null`
    : `${text} ${figureText(model.datum.figure)}`;
}

function figureText({ a, rf }: Figure): string {
  return rf === 0 ? `+a=${a} +b=${a}` : `+a=${a} +rf=${rf}`;
}

function meridian(model: HorizontalModel): string[] {
  return model.meridian === 0 ? [] : [`+pm=${model.meridian}`];
}

function unitText(model: HorizontalModel): string[] {
  return model.unit.kind === "linear" ? [projUnit(model.unit)] : [];
}

function shiftText({ towgs84 }: Shift): string[] {
  return towgs84 ? [`+towgs84=${towgs84.join(",")}`] : [];
}

/**
 * The shift that the text names; else that of the datum by code or name; else that of the EPSG table for the code of
 * the CRS; else none for datums whose ellipsoid is that of WGS 84. A datum on another ellipsoid without any of these
 * would be placed some hundred metres off: refused.
 */
function findShift(model: HorizontalModel, lookup?: EpsgLookup): Shift {
  const { datum } = model;
  const webMercator = model.kind === "projected" && projectionOf(model) === WEB_MERCATOR;
  if (webMercator) return { datum: { operation: "none: Web Mercator stands on WGS 84", accuracy: 2 } };
  const known = findDatumShift(datum.name, datum.code);
  const unshifted = datum.grid !== undefined && isNullGrid(datum.grid);
  if (unshifted && !known?.towgs84.every((value) => value === 0)) {
    return { datum: { operation: "none: the CRS says that its datum is not to be shifted", accuracy: null } };
  }
  if (datum.grid !== undefined && !unshifted)
    throw unsupported(`its datum shift needs the grid ${datum.grid}`);
  if (known && (!datum.towgs84 || sameShift(datum.towgs84, known.towgs84))) {
    const code = known.operation === 0 ? "" : ` (EPSG:${known.operation})`;
    const operation = `${known.names[0]} to WGS 84${code}`;
    const accuracy = shiftAccuracy(known);
    return { towgs84: known.towgs84, datum: { operation, accuracy, datum: known.code } };
  }
  if (datum.towgs84) {
    return {
      towgs84: datum.towgs84,
      datum: { operation: "the shift that the CRS itself names", accuracy: null },
    };
  }
  for (const code of [model.code, model.baseCode]) {
    const text = code === undefined ? undefined : lookup?.(code)?.proj4;
    const towgs84 = translation(text ? shiftOfProjString(text) : undefined);
    if (towgs84)
      return { towgs84, datum: { operation: `the shift of EPSG:${code} in the EPSG table`, accuracy: null } };
  }
  if (datum.name === NO_DATUM) {
    const towgs84 = isGeocentricFigure(datum.figure) ? [0, 0, 0] : undefined;
    return {
      towgs84,
      datum: { operation: "taken as WGS 84: the PROJ string names no datum", accuracy: null },
    };
  }
  if (isGeocentricFigure(datum.figure)) {
    const operation = `"${datum.name}" taken as WGS 84: no transformation known`;
    return { towgs84: [0, 0, 0], datum: { operation, accuracy: null } };
  }
  throw unsupported(
    `no shift from the datum "${datum.name}" to WGS 84 is known`,
    "give the coordinate reference system as a PROJ string with +towgs84, or as an EPSG code",
  );
}

/**
 * Whether a list of grids is PROJ's way to say that nothing is shifted: the grid `null` covers the earth, and those after it
 * are never taken.
 */
function isNullGrid(grids: string): boolean {
  return /^@?null(,|$)/.test(grids.trim());
}

/** Equal parameters, three or seven of them: absent rotations and scale are zero. */
function sameShift(a: readonly number[], b: readonly number[]): boolean {
  return Array.from({ length: 7 }, (_, i) => (a[i] ?? 0) - (b[i] ?? 0)).every(
    (difference) => Math.abs(difference) < 1e-6,
  );
}
