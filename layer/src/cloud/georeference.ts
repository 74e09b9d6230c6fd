import {
  type AccuracyPart,
  accuracyParts,
  type Crs,
  decodeRecord,
  type EpsgLookup,
  type ExactTransform,
  exactTransform,
  resolveCrs,
  type StatedAccuracy,
  statedAccuracy,
} from "@groma/georef";
import type { CopcFile } from "../sources/index.js";

/** What an application says about a data set's coordinates; it goes before what the file says. */
export interface GeoreferenceOptions {
  /** Coordinate system: `EPSG:2056`, `EPSG:2056+5728`, a PROJ string, WKT or PROJJSON. */
  readonly crs?: string | undefined;
  /** Height reference: `EPSG:5728` or `ellipsoidal`. */
  readonly vertical?: string | undefined;
  /** Table of EPSG codes, where `crs` names one that needs it. Default: none. */
  readonly epsg?: EpsgLookup | undefined;
  /** Greatest distance of a drawn point from its exact place, metres. Default: 0.001. */
  readonly tolerance?: number | undefined;
}

/** Where a data set's coordinates lie on the earth, and how sure that is. */
export interface Georeference {
  readonly crs: Crs;
  /** Who named the coordinate system: the application, Groma's own record, or the file's WKT or GeoTIFF keys. */
  readonly basis: "given" | "record" | "file";
  readonly exact: ExactTransform;
  readonly tolerance: number;
  readonly accuracy: StatedAccuracy;
}

/**
 * Settles the coordinate system of a file.
 * @throws CrsError CRS_MISSING, CRS_UNKNOWN, CRS_UNSUPPORTED
 * @throws RecordError where the file's georeference record is damaged
 */
export function georeferenceOf(copc: CopcFile, options: GeoreferenceOptions): Georeference {
  const file = copc.source.name;
  const tolerance = options.tolerance ?? 0.001;
  const record = copc.georeference && decodeRecord(copc.georeference, file);
  const given = options.crs !== undefined || options.vertical !== undefined;
  if (record && !given) {
    const { crs } = record;
    // The record's own fit is the converter's default; what holds here is the tolerance of this page.
    const parts = record.accuracy.map((part) =>
      part.name === "fit" ? { ...part, metres: tolerance } : part,
    );
    return { crs, basis: "record", exact: exactOf(crs, copc), tolerance, accuracy: statedAccuracy(parts) };
  }
  const crs = resolveCrs(
    {
      file,
      given: options.crs,
      givenVertical: options.vertical,
      wkt: copc.wkt ?? record?.crs.wkt,
      geoTiff: copc.geoTiff,
    },
    options.epsg,
  );
  const basis = given ? "given" : "file";
  const parts = accuracyParts(crs, copc.header.scale, tolerance).map((part) => withBasis(part, basis));
  return { crs, basis, exact: exactOf(crs, copc), tolerance, accuracy: statedAccuracy(parts) };
}

function exactOf(crs: Crs, { header }: CopcFile): ExactTransform {
  return exactTransform(crs, (header.min[2] + header.max[2]) / 2);
}

/** Says with the datum operation, the least certain part, that no converter has settled it. */
function withBasis(part: AccuracyPart, basis: "given" | "file"): AccuracyPart {
  if (part.name !== "datum operation") return part;
  const who = basis === "given" ? "for the system given by the user" : "derived in the page from the file";
  return { ...part, note: part.note ? `${part.note}; ${who}` : who };
}
