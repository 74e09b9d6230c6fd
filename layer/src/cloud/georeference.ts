import {
  type AccuracyPart,
  accuracyParts,
  type Crs,
  decodeRecord,
  ENGINE,
  type EpsgLookup,
  fitPlacement,
  type GeoreferenceRecord,
  type OperationReport,
  PlacementError,
  RecordError,
  resolveCrs,
  type StatedAccuracy,
  statedAccuracy,
  type Truth,
  type TruthSources,
  truthOf,
} from "@groma/georef";
import type { CopcFile } from "../sources/index.js";
import { withHeights } from "./heights.js";

/** What an application says about a data set's coordinates; it goes before what the file says. */
export interface GeoreferenceOptions {
  /** Coordinate system: `EPSG:2056`, `EPSG:2056+5728`, a PROJ string, WKT or PROJJSON. */
  readonly crs?: string | undefined;
  /**
   * Height reference: `EPSG:5728` or `ellipsoidal`. A page has no geoids: where this replaces what the conversion
   * found, heights above one are drawn as if they were ellipsoidal, and the accuracy says so.
   */
  readonly vertical?: string | undefined;
  /** Table of EPSG codes, where `crs` or `vertical` names one that needs it. Default: none. */
  readonly epsg?: EpsgLookup | undefined;
  /** Greatest distance of a drawn point from its exact place, metres. Default: 0.001. */
  readonly tolerance?: number | undefined;
}

/** Where a data set's coordinates lie on the earth, and how sure that is. */
export interface Georeference {
  readonly crs: Crs;
  /** Who named the coordinate system: the application, Groma's own record, or the file's WKT or GeoTIFF keys. */
  readonly basis: "given" | "record" | "file";
  /** What the places come from: PROJ at the conversion, a similarity, or proj4js. */
  readonly engine: GeoreferenceRecord["engine"];
  /** Undefined where the places do not come from a conversion that reported it. */
  readonly operation: OperationReport | undefined;
  /** What the map is made of, for whoever makes it again in a worker. */
  readonly sources: TruthSources;
  /** Source coordinates → ECEF. */
  readonly truth: Truth;
  /** Files of the geoids that heights go through; empty where they are drawn as they are. */
  readonly geoids: readonly string[];
  readonly tolerance: number;
  readonly accuracy: StatedAccuracy;
}

/** Said where the file carries a transformation that the application's word takes out of force. */
const OVERRULED = "the transformation that the conversion put into the file is not used";
/** Said where the record speaks of a transformation that the file has lost. */
const LOST = "the transformation of the conversion is no longer in the file; derived in the page by proj4js";

/**
 * Settles the coordinate system of a file.
 * @throws CrsError CRS_MISSING, CRS_UNKNOWN, CRS_UNSUPPORTED
 * @throws RecordError where the file's georeference record or its transformation is damaged
 */
export function georeferenceOf(copc: CopcFile, options: GeoreferenceOptions): Georeference {
  const record = copc.georeference && decodeRecord(copc.georeference, copc.source.name);
  const given = options.crs !== undefined || options.vertical !== undefined;
  if (record && !given) return recorded(record, copc, options);
  const { header, source, wkt, geoTiff, transformation } = copc;
  const { crs: named, vertical, epsg, tolerance = 0.001 } = options;
  const crs =
    record && vertical !== undefined && named === undefined
      ? withHeights(record, vertical, source.name, epsg)
      : resolveCrs({ file: source.name, given: named, givenVertical: vertical, wkt, geoTiff }, epsg);
  const whose = given ? "for the system given by the user" : "derived in the page from the file";
  const remark = record && transformation ? `${whose}; ${OVERRULED}` : whose;
  const map = derived({ crs }, copc);
  const parts = accuracyParts(crs, header.scale, greatestBound(map.truth, copc, tolerance));
  return {
    ...map,
    ...{ crs, basis: given ? "given" : "file", engine: ENGINE, operation: undefined, tolerance },
    accuracy: statedAccuracy(remarked(parts, remark)),
  };
}

/** As the conversion settled it. */
function recorded(
  record: GeoreferenceRecord,
  copc: CopcFile,
  { tolerance = 0.001 }: GeoreferenceOptions,
): Georeference {
  const { crs, similarity, engine, operation } = record;
  const { transformation, header, source } = copc;
  if (engine.name === "similarity" && !similarity) throw withoutSimilarity(source.name);
  const map = derived({ crs, similarity, transformation }, copc);
  const common = { ...map, crs, basis: "record", tolerance } as const;
  const bound = greatestBound(map.truth, copc, tolerance);
  const lost = !transformation && !similarity && (engine.name === "PROJ" || operation !== undefined);
  if (lost) {
    const parts = remarked(accuracyParts(crs, header.scale, bound), LOST);
    return { ...common, engine: ENGINE, operation: undefined, accuracy: statedAccuracy(parts) };
  }
  // The record's own fit is the converter's default; what holds here is the tolerance of this page.
  const parts = record.accuracy.map((part) => (part.name === "fit" ? { ...part, metres: bound } : part));
  return { ...common, engine, operation, accuracy: statedAccuracy(parts) };
}

/**
 * How far a drawn point may be from its exact place, metres: the tolerance, but for data sets so wide that float32
 * alone costs more in their greatest nodes.
 */
function greatestBound(truth: Truth, { header, source }: CopcFile, tolerance: number): number {
  const [minX, minY, minZ] = header.min;
  const [maxX, maxY, maxZ] = header.max;
  try {
    const whole = fitPlacement(truth, { minX, minY, minZ, maxX, maxY, maxZ }, tolerance, source.name);
    return Math.max(tolerance, whole.bound);
  } catch (thrown) {
    // Whoever looks for the sphere around the points finds the same, and says it better.
    if (thrown instanceof PlacementError && thrown.code === "PLACE_DOMAIN") return tolerance;
    throw thrown;
  }
}

/** The map, and what follows from it. */
function derived(
  sources: TruthSources,
  { header, source }: CopcFile,
): Pick<Georeference, "sources" | "truth" | "geoids"> {
  const truth = truthOf(sources, (header.min[2] + header.max[2]) / 2, source.name);
  const steps = typeof truth === "function" ? [] : truth.transformation.steps;
  const geoids = steps.flatMap((step) => (step.kind === "verticalShift" ? [step.window.grid] : []));
  return { sources, truth, geoids };
}

/** Says with the datum operation, the least certain part, that no converter has settled it. */
function remarked(parts: readonly AccuracyPart[], remark: string): AccuracyPart[] {
  return parts.map((part) => {
    if (part.name !== "datum operation") return part;
    return { ...part, note: part.note ? `${part.note}; ${remark}` : remark };
  });
}

function withoutSimilarity(file: string): RecordError {
  return new RecordError({
    code: "RECORD_FIELD",
    file,
    cause:
      "the georeference record of Groma cannot be read: it has no similarity, which its engine stands for",
    fix: "convert the scan again, with its anchor or control points",
  });
}
