import {
  type Crs,
  CrsError,
  decodeRecord,
  type GeoreferenceRecord,
  RecordError,
  resolveCrs,
} from "@groma/georef";
import type { Scan } from "./core.js";
import { epsg } from "./epsg.js";
import { type GivenPlace, isPlaced, type LocalPlace, localPlace } from "./place/local.js";

/** What the user says of the coordinates; it goes before what the files say. */
export interface Given extends GivenPlace {
  /** `none` passes over what the files say. */
  readonly crs?: string | undefined;
  readonly vertical?: string | undefined;
}

/** The coordinate reference system of a file, and who named it. */
export interface Georeferenced {
  readonly crs: Crs;
  readonly basis: "given" | "WKT" | "GeoTIFF keys" | LocalPlace["basis"];
  /** For a data set without a coordinate reference system: where it is put. */
  readonly local?: LocalPlace;
}

/** What a file says of its coordinates. */
export type Named = Pick<Scan, "file" | "wkt" | "geoTiff" | "groma">;

/** `--crs none`. */
const NONE = "none";

/**
 * The coordinate reference system of one file, or the place that it was given instead.
 *
 * @throws CrsError CRS_MISSING, CRS_UNKNOWN, CRS_UNSUPPORTED, CRS_TWICE
 * @throws OptionError, RowsError, ControlError
 */
export async function georeference(scan: Named, given: Given): Promise<Georeferenced> {
  if (isPlaced(given)) {
    refuseSecondPlace(scan, given);
    const local = await localPlace(given);
    return { crs: local.crs, basis: local.basis, local };
  }
  if (given.crs === NONE) throw missing(scan.file, "its coordinate reference system is to be passed over");
  const record = given.crs === undefined && given.vertical === undefined ? readable(scan) : undefined;
  if (!record) return named(scan, given);
  const { crs, similarity, accuracy } = record;
  const basis = "Groma's record";
  return { crs, basis, ...(similarity && { local: { basis, crs, similarity, accuracy } }) };
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
function named(scan: Named, given: Given): Georeferenced {
  const geoTiff = scan.geoTiff && {
    directory: Uint16Array.from(scan.geoTiff.directory),
    doubles: Float64Array.from(scan.geoTiff.doubles),
    ascii: scan.geoTiff.ascii,
  };
  const wkt = wktOnEarth(scan);
  const sources = { file: scan.file, given: given.crs, givenVertical: given.vertical, wkt, geoTiff };
  try {
    const basis = given.crs !== undefined ? "given" : wkt ? "WKT" : "GeoTIFF keys";
    return { crs: resolveCrs(sources, epsg), basis };
  } catch (error) {
    if (!(error instanceof CrsError) || error.code !== "CRS_MISSING") throw error;
    throw missing(error.file, error.cause);
  }
}

/** The WKT of a file, unless it only says that the coordinates are local. */
function wktOnEarth({ wkt }: Named): string | undefined {
  const text = wkt?.trim();
  return text && !/^(LOCAL_CS|ENGCRS|ENGINEERINGCRS)\s*[[(]/i.test(text) ? text : undefined;
}

function missing(file: string, cause: string): CrsError {
  return new CrsError({
    ...{ code: "CRS_MISSING", file, cause },
    fix: "give it with --crs, e.g. --crs EPSG:2056+5728, or say where the scan is with --anchor or --control",
  });
}

function refuseSecondPlace(scan: Named, { crs, vertical }: Given): void {
  const file = scan.file;
  const fix = "leave one of them out; --crs none passes over what the file says";
  const cause = "has a place of its own, and --anchor or --control gives another";
  const second =
    vertical !== undefined ? "--vertical" : crs !== undefined && crs !== NONE ? "--crs" : undefined;
  if (second) throw new CrsError({ code: "CRS_TWICE", file, cause: `what ${second} names ${cause}`, fix });
  if (crs === undefined && (wktOnEarth(scan) || scan.geoTiff)) {
    throw new CrsError({ code: "CRS_TWICE", file, cause: `its coordinate reference system ${cause}`, fix });
  }
}

/**
 * The one coordinate reference system of several inputs.
 *
 * @throws CrsError CRS_MIXED with the list when they differ; as {@link georeference}
 */
export async function commonGeoreference(scans: readonly Named[], given: Given): Promise<Georeferenced> {
  const all: Georeferenced[] = [];
  for (const scan of scans) all.push(await georeference(scan, given));
  const meaning = ({ crs, local }: Georeferenced) =>
    JSON.stringify([
      ...[crs.proj4, crs.horizontalUnit.size, crs.verticalUnit.size, crs.height],
      local?.similarity ?? null,
    ]);
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

/**
 * WKT 1 for an output whose input had none (LAS 1.4 R15 asks for WKT in point formats 6 to 10): the text that was
 * given or the EPSG table's, horizontal and vertical joined as a compound; a local system says that it is one. Undefined
 * where nobody has words for it.
 */
export function wktOf({ crs, local }: Georeferenced): string | undefined {
  // Readers of LAS do not agree on what else than ASCII is.
  const name = crs.name.replaceAll('"', "'").replace(/[^ -~]/g, "");
  if (local) {
    const unit = `UNIT["${crs.horizontalUnit.name}",${crs.horizontalUnit.size}]`;
    return `LOCAL_CS["${name}",LOCAL_DATUM["${name}",32767],${unit},AXIS["x",OTHER],AXIS["y",OTHER]]`;
  }
  if (crs.wkt) return crs.wkt;
  const [horizontal, vertical] = (crs.code?.match(/\d+/g) ?? []).map((code) => epsg(Number(code))?.wkt);
  if (!horizontal || !vertical) return horizontal;
  return `COMPD_CS["${name}",${horizontal},${vertical}]`;
}
