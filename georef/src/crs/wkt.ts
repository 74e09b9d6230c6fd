import type { Unit } from "./crs.js";
import type { Figure } from "./ellipsoids.js";
import type { ConversionModel, CrsModel, DatumModel, HorizontalModel, ParameterId } from "./model.js";
import { findParameter } from "./parameters.js";
import { atEpoch, unknown, unsupported } from "./refusal.js";
import { child, children, epsgCode, isNode, number, text, type WktNode } from "./tree.js";
import { DEGREE, METRE, unitOf } from "./units.js";
import { bursaWolf } from "./wkt-bound.js";
import { readVertical, VERTICAL } from "./wkt-vertical.js";

const PROJECTED = ["PROJCS", "PROJCRS", "PROJECTEDCRS"];
const GEODETIC = ["GEOGCS", "GEOGCRS", "GEOGRAPHICCRS", "GEODCRS", "GEODETICCRS", "GEOCCS"];
const BASE = [...GEODETIC, "BASEGEOGCRS", "BASEGEODCRS"];
const COMPOUND = ["COMPD_CS", "COMPOUNDCRS"];
const UNITS = ["UNIT", "LENGTHUNIT", "ANGLEUNIT", "SCALEUNIT", "LINUNIT"];

/**
 * Reads a CRS from the nodes of a WKT text: WKT1 as GDAL and as ESRI write it, WKT2:2015 and WKT2:2019
 * (OGC 12-063r5, 18-010r11), which share their structure.
 * @throws Refusal when there is no horizontal CRS in it, or one that is not of this earth's surface
 */
export function readWkt(nodes: readonly WktNode[]): CrsModel {
  const [first] = nodes;
  if (!first) throw unknown("the WKT is empty");
  if (first[0] === "COORDINATEMETADATA") throw atEpoch();
  const parts = COMPOUND.includes(first[0]) ? children(first) : nodes;
  let horizontal: HorizontalModel | undefined;
  let vertical: CrsModel["vertical"];
  for (const part of parts) {
    const { source, towgs84, grid } = unbind(part);
    if (VERTICAL.includes(source[0])) vertical = readVertical(source, grid);
    else if (PROJECTED.includes(source[0]) || GEODETIC.includes(source[0])) {
      horizontal = readHorizontal(source, { towgs84, grid });
    }
  }
  if (!horizontal) throw unsupported(`${first[0]}["${text(first, 1)}"] has no geographic or projected part`);
  const compound = COMPOUND.includes(first[0]);
  const named = vertical && !compound ? `${horizontal.name} + ${vertical.name}` : text(first, 1);
  return {
    ...{ name: compound || vertical ? named : horizontal.name, horizontal, vertical },
    code: compound ? epsgCode(first) : undefined,
  };
}

/** What a BOUNDCRS ties to a CRS: a Helmert shift, or a grid file. */
type Bound = Pick<DatumModel, "towgs84" | "grid">;

/** Strips a BOUNDCRS and keeps the transformation to WGS 84, or the name of the grid, that it binds. */
function unbind(node: WktNode): { source: WktNode } & Bound {
  if (node[0] !== "BOUNDCRS") return { source: node };
  const wrapper = child(node, "SOURCECRS");
  const source = wrapper && children(wrapper)[0];
  const transformation = child(node, "ABRIDGEDTRANSFORMATION");
  if (!source || !transformation) throw unknown("a BOUNDCRS lacks its source or its transformation");
  const file = child(transformation, "PARAMETERFILE");
  if (file) return { source, grid: text(file, 2) };
  return { source, towgs84: bursaWolf(transformation) };
}

function readHorizontal(node: WktNode, bound: Bound): HorizontalModel {
  const projected = PROJECTED.includes(node[0]);
  const base = projected ? child(node, ...BASE) : node;
  if (!base) throw unknown(`"${text(node, 1)}" has no geographic CRS underneath`);
  const system = child(node, "CS");
  const geocentric =
    node[0] === "GEOCCS" || (!projected && text(system ?? node, 1).toLowerCase() === "cartesian");
  const axes = children(node, "AXIS");
  const angular = unitNode(base, "angular") ?? primeMeridianUnit(base) ?? DEGREE;
  const unit = projected || geocentric ? (unitNode(node, "linear") ?? METRE) : angular;
  const extension = children(node, "EXTENSION").find((item) => text(item, 1) === "PROJ4");
  return {
    kind: projected ? "projected" : geocentric ? "geocentric" : "geographic",
    name: text(node, 1),
    code: epsgCode(node),
    datum: readDatum(base, bound),
    baseCode: epsgCode(base),
    meridian: readMeridian(base, angular),
    unit,
    conversion: projected ? readConversion(node, unit, angular) : undefined,
    directions: axes.map((axis) => text(axis, 2).toLowerCase()),
    projString: extension && text(extension, 2),
    heightUnit: heightUnit(node, axes, geocentric),
  };
}

/** Unit of the third axis, or ESRI's LINUNIT: what marks a CRS with ellipsoidal heights. */
function heightUnit(node: WktNode, axes: readonly WktNode[], geocentric: boolean): Unit | undefined {
  if (geocentric) return undefined;
  const linear = child(node, "LINUNIT");
  if (linear) return readUnit(linear, "linear");
  const third = axes[2];
  if (!third || text(third, 2).toLowerCase() !== "up") return undefined;
  return unitNode(third, "linear") ?? METRE;
}

function readDatum(base: WktNode, bound: Bound): DatumModel {
  const node = child(base, "DATUM", "GEODETICDATUM", "TRF", "ENSEMBLE", "DATUMENSEMBLE");
  if (!node) throw unknown(`"${text(base, 1)}" has no datum`);
  const extension = children(node, "EXTENSION").find((item) => text(item, 1) === "PROJ4_GRIDS");
  const grid = bound.grid ?? (extension && text(extension, 2));
  const shift = child(node, "TOWGS84")?.slice(1).map(Number);
  if (shift && !([3, 7].includes(shift.length) && shift.every(Number.isFinite))) {
    throw unknown(`TOWGS84 of "${text(node, 1)}" has not three or seven numbers`);
  }
  const towgs84 = bound.towgs84 ?? shift;
  return { name: text(node, 1), code: epsgCode(node), figure: readFigure(node), towgs84, grid };
}

function readFigure(datum: WktNode): Figure {
  const node = child(datum, "ELLIPSOID", "SPHEROID");
  const length = node && unitNode(node, "linear");
  const figure = {
    a: node ? number(node, 2) * (length?.size ?? 1) : Number.NaN,
    rf: node ? number(node, 3) : 0,
  };
  // Anything that is not about the size of the earth would be placed on the earth all the same.
  const earth = Math.abs(figure.a - 6.37e6) < 3e4 && (figure.rf === 0 || figure.rf > 200);
  if (!earth) throw unsupported(`the ellipsoid of "${text(datum, 1)}" is not the earth's`);
  return figure;
}

/**
 * Degrees from Greenwich. OGC gives them in the unit of the CRS; GDAL's WKT1 of the French grads is in degrees all
 * the same, which the value of Paris tells.
 */
function readMeridian(base: WktNode, angular: Unit): number {
  const node = child(base, "PRIMEM", "PRIMEMERIDIAN");
  if (!node) return 0;
  const value = number(node, 2);
  if (!Number.isFinite(value)) throw unknown(`the prime meridian "${text(node, 1)}" has no longitude`);
  const own = unitNode(node, "angular");
  if (!own && Math.abs(value - 2.33722917) < 1e-6) return value;
  return degrees(value, own ?? angular);
}

function primeMeridianUnit(base: WktNode): Unit | undefined {
  const node = child(base, "PRIMEM", "PRIMEMERIDIAN");
  return node && unitNode(node, "angular");
}

function degrees(value: number, unit: Unit): number {
  return unit === DEGREE ? value : (value * unit.size) / DEGREE.size;
}

function readConversion(node: WktNode, linear: Unit, angular: Unit): ConversionModel {
  // WKT1 has the method and its parameters beside each other, WKT2 inside CONVERSION.
  const holder = child(node, "CONVERSION") ?? node;
  const method = child(holder, "METHOD", "PROJECTION");
  if (!method) throw unknown(`"${text(node, 1)}" names no map projection`);
  const parameters = new Map<ParameterId, number>();
  for (const item of children(holder, "PARAMETER")) {
    const known = findParameter(text(item, 1), epsgCode(item));
    if (!known) throw unsupported(`parameter "${text(item, 1)}" of ${text(method, 1)} is not known`);
    const value = number(item, 2);
    if (!Number.isFinite(value)) throw unknown(`parameter "${text(item, 1)}" has no value`);
    if (known.quantity === "angle") {
      parameters.set(known.id, degrees(value, unitNode(item, "angular") ?? angular));
    } else if (known.quantity === "length") {
      parameters.set(known.id, value * (unitNode(item, "linear") ?? linear).size);
    } else parameters.set(known.id, value);
  }
  return { method: text(method, 1), methodCode: epsgCode(method), parameters };
}

/** The unit of a node; of the first axis where WKT2 writes units there. */
export function unitNode(node: WktNode, kind: Unit["kind"]): Unit | undefined {
  const own = children(node, ...UNITS).find((item) => item[0] !== "LINUNIT");
  const inAxis = child(node, "AXIS");
  const found = own ?? (inAxis && child(inAxis, ...UNITS));
  return found && readUnit(found, kind);
}

function readUnit(node: WktNode, kind: Unit["kind"]): Unit {
  const size = number(node, 2);
  if (!(Number.isFinite(size) && size > 0) || isNode(node[1]))
    throw unknown(`unit "${text(node, 1)}" has no size`);
  return unitOf(text(node, 1), kind, size);
}
