import {
  accuracyParts,
  type Crs,
  CrsError,
  encodeRecord,
  type GeoreferenceRecord,
  resolveCrs,
} from "@groma/georef";
import proj4 from "proj4";
import type { Scan } from "./core.js";
import { epsg } from "./epsg.js";

/** Bound on the drawn position that the page keeps by default, metres. */
export const TOLERANCE = 0.001;

/** What the user says of the coordinates; it goes before what the files say. */
export interface Given {
  readonly crs?: string | undefined;
  readonly vertical?: string | undefined;
}

/** The coordinate reference system of a file, and who named it. */
export interface Georeferenced {
  readonly crs: Crs;
  readonly basis: "given" | "WKT" | "GeoTIFF keys";
}

/**
 * The coordinate reference system of one file.
 *
 * @throws CrsError CRS_MISSING, CRS_UNKNOWN, CRS_UNSUPPORTED
 */
export function georeference(scan: Scan, given: Given): Georeferenced {
  const geoTiff = scan.geoTiff && {
    directory: Uint16Array.from(scan.geoTiff.directory),
    doubles: Float64Array.from(scan.geoTiff.doubles),
    ascii: scan.geoTiff.ascii,
  };
  const sources = {
    file: scan.file,
    given: given.crs,
    givenVertical: given.vertical,
    wkt: scan.wkt,
    geoTiff,
  };
  try {
    const basis = given.crs !== undefined ? "given" : scan.wkt?.trim() ? "WKT" : "GeoTIFF keys";
    return { crs: resolveCrs(sources, epsg), basis };
  } catch (error) {
    if (!(error instanceof CrsError) || error.code !== "CRS_MISSING") throw error;
    throw new CrsError({ ...error.toWire(), fix: "give it with --crs, e.g. --crs EPSG:2056+5728" });
  }
}

/**
 * The one coordinate reference system of several inputs.
 *
 * @throws CrsError CRS_MIXED with the list when they differ
 */
export function commonGeoreference(scans: readonly Scan[], given: Given): Georeferenced {
  const all = scans.map((scan) => georeference(scan, given));
  const meaning = ({ crs }: Georeferenced) =>
    JSON.stringify([crs.proj4, crs.horizontalUnit.size, crs.verticalUnit.size, crs.height]);
  const first = all[0]!;
  if (all.some((other) => meaning(other) !== meaning(first))) {
    const list = scans.map((scan, index) => `${scan.file} is in ${all[index]!.crs.name}`).join(", ");
    throw new CrsError({
      ...{ code: "CRS_MIXED", file: scans[0]!.file, cause: `the inputs are in different systems: ${list}` },
      fix: "convert them apart, or give the one that is right for all with --crs",
    });
  }
  return first;
}

/** The georeference record of a data set (docs/record.md, record id 1). */
export function recordOf(crs: Crs, scale: readonly [number, number, number]): Uint8Array {
  const record: GeoreferenceRecord = {
    version: 1,
    crs,
    engine: { name: "proj4js", version: proj4.version },
    accuracy: accuracyParts(crs, scale, TOLERANCE),
  };
  return encodeRecord(record);
}

/**
 * WKT 1 for an output whose input had none (LAS 1.4 R15 asks for WKT in point formats 6 to 10): the text that was
 * given or the EPSG table's, horizontal and vertical joined as a compound. Undefined where nobody has words for it.
 */
export function wktOf(crs: Crs): string | undefined {
  if (crs.wkt) return crs.wkt;
  const [horizontal, vertical] = (crs.code?.match(/\d+/g) ?? []).map((code) => epsg(Number(code))?.wkt);
  if (!horizontal || !vertical) return horizontal;
  return `COMPD_CS["${crs.name.replaceAll('"', "'")}",${horizontal},${vertical}]`;
}
