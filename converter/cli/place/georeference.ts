import {
  type Crs,
  CrsError,
  type CrsNote,
  type CrsSources,
  decodeRecord,
  doubtOfHeights,
  type GeoreferenceRecord,
  keepHeights,
  likelySystems,
  type Place,
  RecordError,
  resolveWithNotes,
  similarSystems,
} from "@groma/georef";
import type { Scan } from "../core/core.js";
import { knownCrs } from "../proj/known-crs.js";
import { written } from "../proj/source.js";
import { chosenProj, type EngineChoice } from "./engine.js";
import { epsg, heightSystems } from "./epsg.js";
import { type GivenPlace, isPlaced, type LocalPlace, localPlace } from "./local.js";
import { expectedWhereabouts } from "./whereabouts.js";

/** What the user says of the coordinates; it goes before what the files say. PROJ is asked what only PROJ knows. */
export interface Given extends GivenPlace, EngineChoice {
  /** `none` ignores what the files declare. */
  readonly crs?: string | undefined;
  readonly vertical?: string | undefined;
}

/** The coordinate reference system of a file, and who named it. */
export interface Georeferenced {
  readonly crs: Crs;
  readonly basis: "given" | "WKT" | "GeoTIFF keys" | LocalPlace["basis"];
  /** For a data set without a coordinate reference system: where it is put. */
  readonly local?: LocalPlace;
  /** Whether the user named the height reference apart from a plane that the file declares. */
  readonly heightGiven?: boolean;
  /** What has to be known of how it was found. */
  readonly notes: readonly CrsNote[];
}

/** What a file says of its coordinates; what PDAL reads has no LAS header. */
export type Named = Pick<Scan, "file" | "wkt" | "geoTiff" | "groma"> &
  Partial<Pick<Scan, "pointFormat" | "wktBit" | "min" | "max">>;

/** `--crs none`. */
const NONE = "none";

/**
 * The coordinate reference system of one file, or the place that it was given instead. One that is not understood here
 * is PROJ's to understand, where there is PROJ.
 *
 * @throws CrsError CRS_MISSING, CRS_UNKNOWN, CRS_UNSUPPORTED, CRS_TWICE
 * @throws OptionError, RowsError, ControlError
 */
export async function georeference(scan: Named, given: Given): Promise<Georeferenced> {
  if (isPlaced(given)) {
    refuseSecondPlace(scan, given);
    const local = await localPlace(given);
    return { crs: local.crs, basis: local.basis, local, notes: [] };
  }
  if (given.crs === NONE) throw missing(scan.file, "--crs none ignores its coordinate reference system");
  const record = readable(scan);
  if (!record || given.crs !== undefined || given.vertical !== undefined) {
    try {
      return await inWordsOfProj(named(scan, given, record), given);
    } catch (error) {
      const known = await knownToProj(scan, given, record, error);
      if (known) return known;
      throw error;
    }
  }
  const { crs, similarity, accuracy } = record;
  const basis = "Groma's record";
  return { crs, basis, notes: [], ...(similarity && { local: { basis, crs, similarity, accuracy } }) };
}

/** The georeference record of a file that has one, unless it is damaged: a conversion makes it anew. */
function readable(scan: Named): GeoreferenceRecord | undefined {
  try {
    return georeferenceRecord(scan);
  } catch (error) {
    if (error instanceof RecordError) return undefined;
    throw error;
  }
}

/** @throws RecordError RECORD_* */
export function georeferenceRecord({ file, groma }: Named): GeoreferenceRecord | undefined {
  const record = groma?.["1"];
  return record === undefined ? undefined : decodeRecord(Buffer.from(record, "base64"), file);
}

/** The coordinate reference system that the user or the file names. */
function named(scan: Named, given: Given, record: GeoreferenceRecord | undefined): Georeferenced {
  const declared = declarationOf(scan, record);
  try {
    const found = resolveWithNotes({ ...declared, given: given.crs, givenVertical: given.vertical }, epsg);
    return { ...found, heightGiven: given.vertical !== undefined && found.basis !== "given" };
  } catch (error) {
    const ofHeights = error instanceof CrsError && /not a known height reference/.test(error.cause);
    if (ofHeights && isNoHeightReference(given.vertical)) {
      throw withSuggestions(error, given.vertical, placeOf(scan, { ...given, vertical: undefined }));
    }
    if (!(error instanceof CrsError) || error.code !== "CRS_MISSING") throw error;
    throw missing(error.file, error.cause);
  }
}

/** What a file says of its coordinates, as it is read. */
function declarationOf(scan: Named, record: GeoreferenceRecord | undefined): CrsSources {
  const { file, geoTiff: keys, pointFormat, wktBit } = scan;
  const geoTiff = keys && {
    directory: Uint16Array.from(keys.directory),
    doubles: Float64Array.from(keys.doubles),
    ascii: keys.ascii,
  };
  const las = pointFormat === undefined || wktBit === undefined ? undefined : { pointFormat, wktBit };
  const recordedHeights = record?.similarity ? undefined : record?.crs;
  return { file, wkt: wktOnEarth(scan), geoTiff, las, recordedHeights };
}

/**
 * The same CRS with WKT of PROJ's, where it was given in words that would be lost otherwise: PROJJSON, and a PROJ string with
 * a geoid, say more than what is read of them here.
 */
async function inWordsOfProj(found: Georeferenced, given: Given): Promise<Georeferenced> {
  const { crs, basis } = found;
  const text = basis === "given" ? given.crs?.trim() : undefined;
  const isWordy = text?.startsWith("{") || (text?.startsWith("+") && crs.height.kind === "geoid");
  const proj = isWordy && given.engine !== "proj4js" ? await chosenProj(given) : undefined;
  if (!proj || text === undefined) return found;
  try {
    const wkt = await written(proj, { name: crs.name, text }, "WKT2:2019");
    return { ...found, crs: { ...crs, wkt } };
  } catch (error) {
    // Whoever places the data set says what PROJ does not understand.
    if (error instanceof CrsError) return found;
    throw error;
  }
}

/** Refusals of CRSs that PROJ may know all the same. */
const PROJ_MAY_KNOW = new Set(["CRS_UNKNOWN", "CRS_UNSUPPORTED"]);

/**
 * What PROJ makes of a coordinate reference system that was refused; nothing where there is no PROJ, or it refuses too.
 */
async function knownToProj(
  scan: Named,
  given: Given,
  record: GeoreferenceRecord | undefined,
  refusal: unknown,
): Promise<Georeferenced | undefined> {
  if (!(refusal instanceof CrsError) || !PROJ_MAY_KNOW.has(refusal.code) || given.engine === "proj4js") {
    return undefined;
  }
  const basis = given.crs !== undefined ? "given" : wktOnEarth(scan) ? "WKT" : "GeoTIFF keys";
  const plane = given.crs ?? wktOnEarth(scan) ?? codeInKeys(scan);
  const text = plane === undefined ? undefined : withHeights(plane.trim(), given.vertical);
  const proj = text === undefined ? undefined : await chosenProj(given);
  if (!proj || text === undefined) return undefined;
  try {
    const known = withDoubt(await knownCrs(proj, { name: scan.file, text }), text);
    const keeps = basis === "given" && given.vertical === undefined;
    const { crs, notes } = keeps
      ? keepHeights(known, declarationOf(scan, record), epsg)
      : { crs: known, notes: [] };
    return { crs, basis, notes, heightGiven: given.vertical !== undefined && basis !== "given" };
  } catch (error) {
    if (error instanceof CrsError) return undefined;
    throw error;
  }
}

function withDoubt(crs: Crs, text: string): Crs {
  const { height } = crs;
  const doubt = height.kind === "unknown" ? undefined : doubtOfHeights(text);
  return doubt === undefined || height.kind === "unknown" ? crs : { ...crs, height: { ...height, doubt } };
}

/** A code with the heights that are given apart from it; nothing where they cannot be joined. */
function withHeights(plane: string, vertical: string | undefined): string | undefined {
  if (vertical === undefined) return plane;
  const heights = /^\s*EPSG:(\d+)\s*$/i.exec(vertical)?.[1];
  const code = /^EPSG:\d+/i.exec(plane)?.[0];
  return heights === undefined || code === undefined ? undefined : `${code}+${heights}`;
}

/** GeoTIFF keys of the codes of a CRS in plane (ProjectedCRSGeoKey, GeodeticCRSGeoKey) and of its heights. */
const [PROJECTED, GEODETIC, VERTICAL] = [3072, 2048, 4096];
/** Codes from here on mean "user-defined" and the like. */
const NO_CODE = 32767;

function codeInKeys({ geoTiff }: Named): string | undefined {
  const directory = geoTiff?.directory ?? [];
  const codeOf = (key: number) => {
    for (let i = 4; i + 3 < directory.length; i += 4) {
      const value = directory[i + 3];
      if (directory[i] === key && directory[i + 1] === 0 && value > 0 && value < NO_CODE) return value;
    }
    return undefined;
  };
  const plane = codeOf(PROJECTED) ?? codeOf(GEODETIC);
  const heights = codeOf(VERTICAL);
  if (plane === undefined) return undefined;
  return heights === undefined ? `EPSG:${plane}` : `EPSG:${plane}+${heights}`;
}

/** Whether a height reference is given in words of which none is known: neither a code nor `ellipsoidal`. */
function isNoHeightReference(vertical: string | undefined): vertical is string {
  return vertical !== undefined && !/^\s*(EPSG:\d+|ellipsoidal)\s*$/i.test(vertical);
}

/** Where the middle of a file lies; undefined where that cannot be known. */
function placeOf(scan: Named, given: Given): Place | undefined {
  const { min, max } = scan;
  if (!min || !max) return undefined;
  try {
    return expectedWhereabouts(named(scan, given, undefined), { min, max }).centre;
  } catch (error) {
    if (error instanceof CrsError) return undefined;
    throw error;
  }
}

/** The same refusal with the height systems that may be meant, else those in use at the place. */
function withSuggestions(refusal: CrsError, text: string, place: Place | undefined): CrsError {
  const systems = heightSystems();
  const similar = similarSystems(systems, text, place);
  const local = similar.length === 0 && place ? likelySystems(systems, { ...place, unit: 1 }) : [];
  const names = [...similar, ...local].map((system) => `EPSG:${system.code} (${system.name})`).join(", ");
  if (names === "") return refusal;
  const { code, file, cause } = refusal;
  const which = similar.length > 0 ? "its EPSG code" : "an EPSG code, of those in use there";
  return new CrsError({ code, file, cause, fix: `give ${which}: ${names}; or ellipsoidal` });
}

/** The WKT of a file, unless it only says that the coordinates are local. */
function wktOnEarth({ wkt }: Named): string | undefined {
  const text = wkt?.trim();
  return text && !/^(LOCAL_CS|ENGCRS|ENGINEERINGCRS)\s*[[(]/i.test(text) ? text : undefined;
}

function missing(file: string, cause: string): CrsError {
  return new CrsError({
    ...{ code: "CRS_MISSING", file, cause },
    fix: "give it with --crs, e.g. --crs EPSG:2056+5728, or give the position of the scan with --anchor or --control",
  });
}

function refuseSecondPlace(scan: Named, given: Given): void {
  const { crs, vertical } = given;
  const file = scan.file;
  const fix = "omit one of them; --crs none ignores the file's CRS";
  const cause = "already places the scan, and --anchor or --control places it elsewhere";
  const way = given.control === undefined ? "--anchor" : "--control";
  if (vertical !== undefined) {
    throw new CrsError({
      ...{ code: "CRS_TWICE", file },
      cause: `--vertical cannot be used with ${way}, whose heights are above the WGS 84 ellipsoid`,
      fix: `leave --vertical out, or ${way}`,
    });
  }
  if (crs !== undefined && crs !== NONE) {
    throw new CrsError({ code: "CRS_TWICE", file, cause: `what --crs names ${cause}`, fix });
  }
  if (crs === undefined && (wktOnEarth(scan) || scan.geoTiff)) {
    throw new CrsError({ code: "CRS_TWICE", file, cause: `its coordinate reference system ${cause}`, fix });
  }
}
