import { atEpoch, unknown } from "./refusal.js";
import type { WktItem, WktNode } from "./tree.js";

type Json = Readonly<Record<string, unknown>>;

/** WKT2 keyword of each PROJJSON type of CRS. */
const KEYWORDS: ReadonlyMap<string, string> = new Map([
  ["GeographicCRS", "GEOGCRS"],
  ["GeodeticCRS", "GEODCRS"],
  ["ProjectedCRS", "PROJCRS"],
  ["VerticalCRS", "VERTCRS"],
  ["CompoundCRS", "COMPOUNDCRS"],
  ["BoundCRS", "BOUNDCRS"],
]);

/** Units that PROJJSON writes as a bare word. */
const WORDS: ReadonlyMap<string, readonly [keyword: string, size: number]> = new Map<
  string,
  readonly [keyword: string, size: number]
>([
  ["metre", ["LENGTHUNIT", 1]],
  ["degree", ["ANGLEUNIT", Math.PI / 180]],
  ["unity", ["SCALEUNIT", 1]],
]);

const UNIT_KEYWORDS: ReadonlyMap<string, string> = new Map([
  ["LinearUnit", "LENGTHUNIT"],
  ["AngularUnit", "ANGLEUNIT"],
  ["ScaleUnit", "SCALEUNIT"],
]);

/** PROJJSON is WKT2 in other brackets (PROJ, projjson.schema.json 0.7): the same CRS as a tree of WKT2. */
export function projJsonTree(source: string): WktNode {
  let json: unknown;
  try {
    json = JSON.parse(source);
  } catch {
    throw unknown("the text is no JSON that can be read");
  }
  return crs(object(json, "the text"));
}

function crs(json: Json): WktNode {
  if (json.type === "CoordinateMetadata") throw atEpoch();
  const keyword = KEYWORDS.get(string(json.type));
  if (!keyword) throw unknown(`PROJJSON of type "${string(json.type)}" is no CRS that can be read`);
  if (keyword === "COMPOUNDCRS") {
    const components = list(json.components).map((part) => crs(object(part, "a component")));
    return node(keyword, string(json.name), ...components, id(json));
  }
  if (keyword === "BOUNDCRS") {
    const source = node("SOURCECRS", crs(object(json.source_crs, "source_crs")));
    return node(keyword, source, transformation(object(json.transformation, "transformation")));
  }
  if (keyword === "VERTCRS") {
    const datum = optional(json.datum) ?? optional(json.datum_ensemble);
    return node(
      keyword,
      string(json.name),
      datum && node("VDATUM", string(datum.name)),
      ...axes(json),
      id(json),
    );
  }
  if (keyword === "PROJCRS") {
    const base = node("BASEGEOGCRS", ...geodetic(object(json.base_crs, "base_crs")));
    const conversion = object(json.conversion, "conversion");
    const content = [...operation(conversion)];
    return node(
      keyword,
      string(json.name),
      base,
      node("CONVERSION", string(conversion.name), ...content),
      ...axes(json),
      id(json),
    );
  }
  return node(keyword, ...geodetic(json));
}

/** Name, datum, prime meridian, coordinate system and identifier of a geodetic CRS. */
function geodetic(json: Json): (WktItem | undefined)[] {
  const datum = optional(json.datum) ?? object(json.datum_ensemble, "the datum");
  const figure = object(datum.ellipsoid, "the ellipsoid");
  const meridian = optional(datum.prime_meridian);
  const ellipsoid = node("ELLIPSOID", string(figure.name), ...radii(figure));
  return [
    string(json.name),
    node("DATUM", string(datum.name), ellipsoid, id(datum)),
    meridian && node("PRIMEM", string(meridian.name), ...measure(meridian.longitude)),
    ...axes(json),
    id(json),
  ];
}

function radii(figure: Json): (WktItem | undefined)[] {
  const a = measured(figure.semi_major_axis ?? figure.radius);
  const b = figure.semi_minor_axis === undefined ? undefined : measured(figure.semi_minor_axis);
  if (figure.inverse_flattening !== undefined) return [a, Number(figure.inverse_flattening)];
  return [a, b === undefined || a === b ? 0 : a / (a - b)];
}

/** Metres of a value that may carry its unit. */
function measured(value: unknown): number {
  const [amount, unit] = measure(value);
  return Number(amount) * (unit ? Number((unit as WktNode)[2]) : 1);
}

/** A value with its unit: a number, or `{ value, unit }`. */
function measure(value: unknown): [WktItem, WktItem?] {
  const own = optional(value);
  if (!own) return [Number(value)];
  const unit = unitNode(own.unit);
  return unit ? [Number(own.value), unit] : [Number(own.value)];
}

function operation(json: Json): (WktItem | undefined)[] {
  const method = object(json.method, "the method");
  return [
    node("METHOD", string(method.name), id(method)),
    ...list(json.parameters).map((part) => {
      const item = object(part, "a parameter");
      const file = typeof item.value === "string";
      const value = file ? string(item.value) : Number(item.value);
      return node(
        file ? "PARAMETERFILE" : "PARAMETER",
        string(item.name),
        value,
        unitNode(item.unit),
        id(item),
      );
    }),
  ];
}

function transformation(json: Json): WktNode {
  return node("ABRIDGEDTRANSFORMATION", string(json.name), ...operation(json), id(json));
}

function axes(json: Json): (WktItem | undefined)[] {
  const system = optional(json.coordinate_system);
  if (!system) return [];
  const parts = list(system.axis).map((part) => {
    const axis = object(part, "an axis");
    return node("AXIS", string(axis.name), string(axis.direction), unitNode(axis.unit));
  });
  return [node("CS", string(system.subtype), parts.length), ...parts];
}

function unitNode(unit: unknown): WktNode | undefined {
  if (typeof unit === "string") {
    const word = WORDS.get(unit);
    if (!word) throw unknown(`unit "${unit}" is not known`);
    return [word[0], unit, word[1]];
  }
  const own = optional(unit);
  if (!own) return undefined;
  return [UNIT_KEYWORDS.get(string(own.type)) ?? "UNIT", string(own.name), Number(own.conversion_factor)];
}

function id(json: Json): WktNode | undefined {
  const own = optional(json.id);
  return own && node("ID", string(own.authority), Number(own.code));
}

function node(keyword: string, ...content: (WktItem | undefined)[]): WktNode {
  return [keyword, ...content.filter((item): item is WktItem => item !== undefined)];
}

function optional(value: unknown): Json | undefined {
  return typeof value === "object" && value !== null && !Array.isArray(value) ? (value as Json) : undefined;
}

function object(value: unknown, what: string): Json {
  const own = optional(value);
  if (!own) throw unknown(`PROJJSON lacks ${what}`);
  return own;
}

function list(value: unknown): readonly unknown[] {
  return Array.isArray(value) ? value : [];
}

function string(value: unknown): string {
  return typeof value === "string" ? value : "";
}
