import type { EpsgLookup, GeoTiffKeys } from "./crs.js";
import { ellipsoidByCode } from "./ellipsoids.js";
import { readEpsg, readEpsgVertical } from "./epsg.js";
import { type KeyValues, readKeys } from "./geotiff-keys.js";
import { conversionNodes } from "./geotiff-projection.js";
import type { CrsModel, HorizontalModel, VerticalModel } from "./model.js";
import { unknown, unsupported } from "./refusal.js";
import type { WktItem, WktNode } from "./tree.js";
import { directed, unitByCode, unitOf } from "./units.js";
import { readWkt } from "./wkt.js";

const MODEL_TYPE = 1024;
const GEOGRAPHIC_TYPE = 2048;
const GEOGRAPHIC_CITATION = 2049;
const DATUM = 2050;
const ANGULAR_UNITS = 2054;
const ELLIPSOID = 2056;
const SEMI_MAJOR_AXIS = 2057;
const SEMI_MINOR_AXIS = 2058;
const INVERSE_FLATTENING = 2059;
const MERIDIAN_LONGITUDE = 2061;
const TO_WGS84 = 2062;
const PROJECTED_TYPE = 3072;
const PROJECTED_CITATION = 3073;
const LINEAR_UNITS = 3076;
const LINEAR_UNIT_SIZE = 3077;
const VERTICAL_TYPE = 4096;
const VERTICAL_UNITS = 4099;

const USER_DEFINED = 32767;

/** Codes that GeoTIFF 1.0 gave to heights over ellipsoids, before EPSG used them otherwise (annex of its section 6). */
const ELLIPSOIDAL_HEIGHTS = [5001, 5033] as const;
/** Vertical CRSs that GeoTIFF 1.0 numbered by itself: NGVD29, NAVD88 and their EPSG codes. */
const OLD_VERTICALS: ReadonlyMap<number, number> = new Map([
  [5102, 5702],
  [5103, 5703],
]);

/**
 * Reads the CRS of GeoTIFF keys: EPSG codes through the table, or user-defined ones by their parameters.
 * @returns undefined when the keys name no CRS at all
 * @throws Refusal
 */
export function readGeoTiff(keys: GeoTiffKeys, lookup: EpsgLookup | undefined): CrsModel | undefined {
  const values = readKeys(keys);
  const horizontal = readHorizontal(values, lookup);
  if (!horizontal) return undefined;
  const vertical = readVertical(values, lookup) ?? horizontal.vertical;
  const name = vertical ? `${horizontal.horizontal.name} + ${vertical.name}` : horizontal.name;
  return { ...horizontal, name, vertical };
}

/**
 * Reads the heights of GeoTIFF keys alone, whatever they say of the plane.
 * @returns undefined when the keys name neither a vertical CRS nor a unit of z
 * @throws Refusal
 */
export function readGeoTiffHeights(
  keys: GeoTiffKeys,
  lookup: EpsgLookup | undefined,
): VerticalModel | undefined {
  return readVertical(readKeys(keys), lookup);
}

function readHorizontal(values: KeyValues, lookup: EpsgLookup | undefined): CrsModel | undefined {
  const projected = code(values, PROJECTED_TYPE);
  const geographic = code(values, GEOGRAPHIC_TYPE);
  if (projected !== undefined && projected !== USER_DEFINED) {
    return withUnit(readEpsg([projected], lookup), values);
  }
  if (projected === USER_DEFINED || values.get(MODEL_TYPE) === 1)
    return readWkt([projectedNode(values, lookup)]);
  if (geographic === undefined) return undefined;
  if (values.get(MODEL_TYPE) === 3) throw unsupported("geocentric GeoTIFF keys are not supported");
  if (geographic === USER_DEFINED) return readWkt([["GEOGCS", ...geographicContent(values)]]);
  return readEpsg([geographic], lookup);
}

/**
 * Files in feet that name the CRS of metres are common (State Plane): the stated unit is the one of the
 * coordinates, the false origin keeps its length. The code is that of metres, and whoever looked it up would take feet
 * for these: it is gone.
 */
function withUnit(model: CrsModel, values: KeyValues): CrsModel {
  const unit = linearUnit(values);
  if (!unit || unit.size === model.horizontal.unit.size || model.horizontal.kind !== "projected")
    return model;
  const name = `${model.name} in ${unit.name}`;
  const horizontal: HorizontalModel = { ...model.horizontal, name, code: undefined, unit };
  return { ...model, name, code: undefined, horizontal };
}

function linearUnit(values: KeyValues) {
  const unit = code(values, LINEAR_UNITS);
  if (unit === undefined) return undefined;
  if (unit === USER_DEFINED) {
    const size = values.get(LINEAR_UNIT_SIZE);
    if (typeof size !== "number" || !(size > 0))
      throw unknown("the GeoTIFF keys name a linear unit without its size");
    return unitOf("unit", "linear", size);
  }
  const known = unitByCode(unit);
  if (known?.kind !== "linear") throw unsupported(`linear unit ${unit} of the GeoTIFF keys is not known`);
  return known;
}

/** User-defined projected keys as a node of WKT1, so that one reader serves all notations. */
function projectedNode(values: KeyValues, lookup: EpsgLookup | undefined): WktNode {
  const name = values.get(PROJECTED_CITATION) ?? values.get(1026) ?? "user-defined";
  const unit = linearUnit(values);
  const nodes: WktItem[] = [String(name), baseNode(values, lookup), ...conversionNodes(values)];
  if (unit) nodes.push(["UNIT", unit.name, unit.size]);
  return ["PROJCS", ...nodes];
}

function baseNode(values: KeyValues, lookup: EpsgLookup | undefined): WktNode {
  const geographic = code(values, GEOGRAPHIC_TYPE);
  if (geographic === undefined || geographic === USER_DEFINED)
    return ["GEOGCS", ...geographicContent(values)];
  const { horizontal } = readEpsg([geographic], lookup);
  const { datum, meridian } = horizontal;
  const shift: WktItem[] = datum.towgs84 ? [["TOWGS84", ...datum.towgs84]] : [];
  const id: WktItem[] = datum.code === undefined ? [] : [["ID", "EPSG", datum.code]];
  return [
    "GEOGCS",
    horizontal.name,
    ["DATUM", datum.name, ["SPHEROID", "", datum.figure.a, datum.figure.rf], ...shift, ...id],
    ["PRIMEM", "", meridian, ["ANGLEUNIT", "degree", Math.PI / 180]],
    ["UNIT", horizontal.unit.name, horizontal.unit.size],
  ];
}

function geographicContent(values: KeyValues): WktItem[] {
  const datum = code(values, DATUM);
  const shift = values.get(TO_WGS84);
  const figure = figureOf(values);
  const angular = unitByCode(code(values, ANGULAR_UNITS) ?? 9102);
  if (angular?.kind !== "angular") throw unsupported("the angular unit of the GeoTIFF keys is not known");
  const name =
    datum === undefined || datum === USER_DEFINED ? String(values.get(GEOGRAPHIC_CITATION) ?? "") : "";
  const node: WktItem[] = ["DATUM", name, ["SPHEROID", "", figure.a, figure.rf]];
  if (Array.isArray(shift) && (shift.length === 3 || shift.length === 7)) node.push(["TOWGS84", ...shift]);
  if (datum !== undefined && datum !== USER_DEFINED) node.push(["ID", "EPSG", datum]);
  const meridian = values.get(MERIDIAN_LONGITUDE);
  return [
    String(values.get(GEOGRAPHIC_CITATION) ?? "user-defined"),
    node as unknown as WktNode,
    ["PRIMEM", "", typeof meridian === "number" ? meridian : 0],
    ["UNIT", angular.name, angular.size],
  ];
}

function figureOf(values: KeyValues): { a: number; rf: number } {
  const a = values.get(SEMI_MAJOR_AXIS);
  const b = values.get(SEMI_MINOR_AXIS);
  const rf = values.get(INVERSE_FLATTENING);
  if (typeof a === "number" && typeof rf === "number") return { a, rf };
  if (typeof a === "number" && typeof b === "number") return { a, rf: a === b ? 0 : a / (a - b) };
  const known = ellipsoidByCode(code(values, ELLIPSOID) ?? -1);
  if (!known) throw unsupported("the GeoTIFF keys name no ellipsoid that is known");
  return known;
}

function readVertical(values: KeyValues, lookup: EpsgLookup | undefined): VerticalModel | undefined {
  const vertical = code(values, VERTICAL_TYPE);
  const units = code(values, VERTICAL_UNITS);
  const unit = units === undefined ? undefined : unitByCode(units);
  if (units !== undefined && unit?.kind !== "linear")
    throw unsupported(`vertical unit ${units} of the GeoTIFF keys is not known`);
  if (vertical === undefined || vertical === USER_DEFINED) {
    return unit && { name: "height", reference: "unknown", unit };
  }
  const [first, last] = ELLIPSOIDAL_HEIGHTS;
  if (vertical >= first && vertical <= last)
    return { name: "ellipsoidal height", reference: "ellipsoidal", unit };
  const found = readEpsgVertical(OLD_VERTICALS.get(vertical) ?? vertical, lookup);
  // The unit that the file states is that of its z, whatever the unit of the CRS it names.
  const down = (found.unit?.size ?? 1) < 0;
  return { ...found, unit: unit ? directed(unit, down) : found.unit };
}

/** A key that holds a code; 0 and values that are none are as good as absent. */
function code(values: KeyValues, key: number): number | undefined {
  const value = values.get(key);
  return typeof value === "number" && value > 0 ? value : undefined;
}
