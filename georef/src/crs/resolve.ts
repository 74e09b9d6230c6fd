import type { CrsError } from "../errors/errors.js";
import type { Crs, CrsSources, EpsgLookup } from "./crs.js";
import { epsgCodes, readEpsg, readEpsgVertical } from "./epsg.js";
import { readGeoTiff } from "./geotiff.js";
import type { CrsModel, VerticalModel } from "./model.js";
import { normalise } from "./normalise.js";
import { readProjString } from "./proj-string.js";
import { projJsonTree } from "./projjson.js";
import { Refusal, unknown } from "./refusal.js";
import { excerpt, parseWkt } from "./tree.js";
import { readWkt } from "./wkt.js";

/**
 * The coordinate reference system of a file: what the user gives, else its WKT, else its GeoTIFF keys.
 * A height reference given by the user replaces the one of the file; the unit of z then is that of the given one.
 *
 * @param lookup table of EPSG codes; without one, codes are refused as unknown
 * @throws CrsError CRS_MISSING (no source says anything), CRS_UNKNOWN (not understood), CRS_UNSUPPORTED (understood,
 *   but not done here: grids, depths, other axes, other projections)
 */
export function resolveCrs(sources: CrsSources, lookup?: EpsgLookup): Crs {
  try {
    const wkt = textOf(sources.wkt);
    const given = textOf(sources.given);
    const file = read(sources, given, wkt, lookup);
    const model = withVertical(file, textOf(sources.givenVertical), lookup);
    const source = given === undefined ? wkt : isWkt(given) ? given : undefined;
    return source === undefined ? normalise(model, lookup) : { ...normalise(model, lookup), wkt: source };
  } catch (error) {
    if (error instanceof Refusal) throw named(error, sources);
    throw error;
  }
}

/** VLRs are padded with NULs; a text of nothing but these is no text. */
function textOf(text: string | undefined): string | undefined {
  const trimmed = text?.replace(/\0/g, "").trim();
  return trimmed === "" ? undefined : trimmed;
}

function named(refusal: Refusal, sources: CrsSources): CrsError {
  return refusal.toError(sources.file);
}

function read(
  sources: CrsSources,
  given: string | undefined,
  wkt: string | undefined,
  lookup: EpsgLookup | undefined,
): CrsModel {
  if (given !== undefined) return readText(given, lookup);
  if (wkt !== undefined) return readWkt(parseWkt(wkt));
  const keys = sources.geoTiff && readGeoTiff(sources.geoTiff, lookup);
  if (keys) return keys;
  throw new Refusal("CRS_MISSING", "it does not say which coordinate reference system it is in");
}

function isWkt(text: string): boolean {
  return /^[A-Za-z]\w*\s*\[/.test(text);
}

function readText(text: string, lookup: EpsgLookup | undefined): CrsModel {
  const codes = epsgCodes(text);
  if (codes) return readEpsg(codes, lookup);
  if (text.startsWith("{")) return readWkt([projJsonTree(text)]);
  if (isWkt(text)) return readWkt(parseWkt(text));
  const init = /\+init=(epsg:\d+)\b/i.exec(text);
  if (init) return readEpsg(epsgCodes(init[1])!, lookup);
  if (/\+?proj=/.test(text)) return readProjString(text);
  throw unknown(`"${excerpt(text)}" is no EPSG code, PROJ string, WKT or PROJJSON`);
}

function withVertical(model: CrsModel, given: string | undefined, lookup: EpsgLookup | undefined): CrsModel {
  if (given === undefined) return model;
  const vertical = readVerticalText(given, model, lookup);
  return { ...model, name: `${model.horizontal.name} + ${vertical.name}`, code: undefined, vertical };
}

function readVerticalText(text: string, model: CrsModel, lookup: EpsgLookup | undefined): VerticalModel {
  if (text.toLowerCase() === "ellipsoidal") {
    return { name: "ellipsoidal height", reference: "ellipsoidal", unit: model.vertical?.unit };
  }
  const codes = epsgCodes(text);
  if (!codes || codes[1] !== undefined) {
    throw unknown(
      `"${excerpt(text)}" is no height reference`,
      "give a vertical EPSG code such as EPSG:5728, or ellipsoidal",
    );
  }
  return readEpsgVertical(codes[0], lookup);
}
