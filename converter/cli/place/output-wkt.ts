import { type Crs, CrsError, isAboveOwnEllipsoid, isShifted, resolveCrs, sameHeights } from "@groma/georef";
import { epsg } from "./epsg.js";
import type { Georeferenced } from "./georeference.js";

/**
 * The WKT that an output declares its coordinates with: LAS 1.4 R15 (2.6) asks for it in point formats 6 to 10, and it
 * is the only declaration there. The text that was read or the EPSG table's, with the heights that were settled; a local
 * system says that it is one.
 */
export function outputWkt({ crs, local }: Georeferenced): string {
  if (local) {
    const name = quoted(crs.name);
    const unit = unitNode(crs.horizontalUnit);
    return `LOCAL_CS[${name},LOCAL_DATUM[${name},32767],${unit},AXIS["x",OTHER],AXIS["y",OTHER]]`;
  }
  if (crs.wkt !== undefined && saysHeights(crs.wkt, crs)) return crs.wkt;
  const plane = planeText(crs);
  if (saysHeights(plane, crs)) return plane;
  return /^\s*(PROJCRS|PROJECTEDCRS|GEOGCRS|GEOGRAPHICCRS|GEODCRS|GEODETICCRS|BOUNDCRS)\b/i.test(plane)
    ? compound2(plane, crs)
    : `COMPD_CS[${quoted(crs.name)},${plane},${vertical1(crs)}]`;
}

/** Whether a text declares the heights that were settled; what PROJ alone reads has none apart from a compound CRS. */
function saysHeights(wkt: string, crs: Crs): boolean {
  const said = readHere(wkt, crs);
  if (!said) return isCompound(wkt) || (crs.height.kind === "unknown" && !crs.verticalUnit.declared);
  return sameHeights(said, crs) && (said.verticalUnit.declared || !crs.verticalUnit.declared);
}

function isCompound(wkt: string): boolean {
  return /^\s*(COMPD_CS|COMPOUNDCRS)\b/i.test(wkt);
}

function readHere(wkt: string, { name }: Crs): Crs | undefined {
  try {
    return resolveCrs({ file: name, given: wkt }, epsg);
  } catch (error) {
    if (error instanceof CrsError) return undefined;
    throw error;
  }
}

/** The horizontal part as WKT: of the text that was read, of the EPSG table, else GDAL's form of a PROJ string. */
function planeText(crs: Crs): string {
  if (crs.wkt !== undefined) return firstPart(crs.wkt);
  const code = /^EPSG:(\d+)/.exec(crs.code ?? "")?.[1];
  const entry = code === undefined ? undefined : epsg(Number(code))?.wkt;
  return entry === undefined ? ofProjString(crs) : firstPart(entry);
}

/** The first part of a compound CRS; the text itself where it is none. Brackets in quoted names are no brackets. */
function firstPart(wkt: string): string {
  const begin = /^\s*(?:COMPD_CS|COMPOUNDCRS)\s*\[\s*"(?:[^"]|"")*"\s*,\s*/i.exec(wkt)?.[0].length;
  if (begin === undefined) return wkt;
  let depth = 0;
  let inName = false;
  for (let i = begin; i < wkt.length; i++) {
    if (wkt[i] === '"') inName = !inName;
    else if (!inName && wkt[i] === "[") depth++;
    else if (!inName && wkt[i] === "]" && --depth === 0) return wkt.slice(begin, i + 1);
  }
  return wkt;
}

/**
 * Vertical part of WKT 1 (OGC 01-009): datum type 2005 above a geoid, 2002 above the ellipsoid of the plane's datum. It has no
 * words for heights above that of WGS 84 over a plane of another datum: readers would take them for the other.
 */
function vertical1(crs: Crs): string {
  const { height, verticalUnit, proj4 } = crs;
  const own = ownVertical({ height, verticalUnit });
  if (own) return own.wkt;
  const [name, type] =
    height.kind === "geoid"
      ? [quoted(height.model), 2005]
      : height.kind === "ellipsoidal" && (isAboveOwnEllipsoid(crs) || !isShifted(proj4))
        ? ['"Ellipsoid"', 2002]
        : ['"unknown"', 2005];
  const axis = verticalUnit.size < 0 ? 'AXIS["Depth",DOWN]' : 'AXIS["Up",UP]';
  return `VERT_CS[${name},VERT_DATUM[${name},${type}],${unitNode({ ...verticalUnit, size: Math.abs(verticalUnit.size) })},${axis}]`;
}

/**
 * Code and text of the height system that is named, unless z is in another unit than it says: the unit of the file goes
 * before that of the system.
 */
function ownVertical({
  height,
  verticalUnit,
}: Pick<Crs, "height" | "verticalUnit">): { code: number; wkt: string } | undefined {
  const code = height.kind === "geoid" ? height.epsg : undefined;
  const wkt = code === undefined ? undefined : epsg(code)?.wkt;
  return code !== undefined && wkt?.includes(`UNIT["${verticalUnit.name}",`) ? { code, wkt } : undefined;
}

/** A compound of WKT 2 (OGC 18-010r11), which has no heights above the ellipsoid alone. */
function compound2(plane: string, { name, height, verticalUnit }: Crs): string {
  if (height.kind === "ellipsoidal") return plane;
  const vertical = height.kind === "geoid" ? quoted(height.model) : '"unknown"';
  const unit = `LENGTHUNIT[${quoted(verticalUnit.name)},${Math.abs(verticalUnit.size)}]`;
  const own = ownVertical({ height, verticalUnit });
  const id = own ? `,ID["EPSG",${own.code}]` : "";
  const direction = verticalUnit.size < 0 ? '"depth (D)",down' : '"gravity-related height (H)",up';
  const axis = `CS[vertical,1],AXIS[${direction}],${unit}`;
  return `COMPOUNDCRS[${quoted(name)},${plane},VERTCRS[${vertical},VDATUM[${vertical}],${axis}${id}]]`;
}

/** GDAL's form of what WKT 1 has no words for: readers that do not know it find the datum at least. */
function ofProjString({ name, proj4, horizontalUnit }: Crs): string {
  const value = (key: string) => new RegExp(`\\+${key}=(\\S+)`).exec(proj4)?.[1];
  const a = Number(value("a"));
  const b = value("b");
  const rf = value("rf") ?? (b === undefined || Number(b) === a ? 0 : a / (a - Number(b)));
  const shift = value("towgs84")?.split(",");
  const seven = shift && Array.from({ length: 7 }, (_, i) => shift[i] ?? "0");
  const datum = `DATUM["unknown",SPHEROID["unknown",${a},${rf}]${seven ? `,TOWGS84[${seven.join(",")}]` : ""}]`;
  const meridian = `PRIMEM["",${value("pm") ?? 0}],UNIT["degree",0.0174532925199433]`;
  const base = `GEOGCS["unknown",${datum},${meridian}]`;
  if (/\+proj=longlat\b/.test(proj4)) return base;
  const extension = `EXTENSION["PROJ4","${proj4}"]`;
  return `PROJCS[${quoted(name)},${base},PROJECTION["custom_proj4"],${unitNode(horizontalUnit)},${extension}]`;
}

function unitNode({ name, size }: Crs["horizontalUnit"]): string {
  return `UNIT[${quoted(name)},${size}]`;
}

/** A name in quotes. Readers of LAS do not agree on what else than ASCII is. */
function quoted(name: string): string {
  return `"${name.replaceAll('"', "'").replace(/[^ -~]/g, "")}"`;
}
