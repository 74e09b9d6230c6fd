import {
  type AccuracyPart,
  accuracyParts,
  type Crs,
  type CrsNote,
  decodeRecord,
  decodeRecordFile,
  decodeTransformation,
  domainAround,
  ENGINE,
  type EpsgLookup,
  encodeRecord,
  everyStep,
  type GeoreferenceRecord,
  GromaError,
  greatestBound,
  type OperationReport,
  type PackedEpsg,
  RECORD_FILE_MOST,
  RecordError,
  requireSame,
  type StatedAccuracy,
  sameHeights,
  statedAccuracy,
  type Truth,
  type TruthSources,
  truthOf,
  withWorthThere,
} from "@groma/georef";
import type { PointSource } from "../sources/contract/point-source.js";
import { type OpenOptions, readWhole, type SourceLike } from "../sources/open-source.js";
import { declaredCrs, packagedEpsg } from "./declared-crs.js";
import { type HeightData, packagedHeights } from "./height-data.js";
import {
  crsWithHeights,
  type Declared,
  derivedByEgm96,
  lookupFor,
  operationRegiven,
  regiven,
  systemAbroad,
} from "./heights.js";

/** What an application says about a data set's coordinates; it goes before what the file says. */
export interface GeoreferenceOptions {
  /** Coordinate system: `EPSG:2056`, `EPSG:2056+5728`, a PROJ string, WKT or PROJJSON. */
  readonly crs?: string | undefined;
  /**
   * Height reference: `EPSG:5728` or `ellipsoidal`. Where the conversion settled the same one it stands as it is. Else
   * heights above a geoid are placed by EGM96 in place of a country's own model, and the accuracy says what that is
   * worth; in plane the conversion's way stays.
   */
  readonly vertical?: string | undefined;
  /** Table of EPSG codes that goes before the one beside this library. Default: none. */
  readonly epsg?: EpsgLookup | undefined;
  /** Where the table of EPSG codes comes from. Default: the file beside this library, fetched when needed. */
  readonly epsgTable?: (() => Promise<PackedEpsg>) | undefined;
  /** Where height systems and the geoid come from. Default: the files beside this library, fetched when needed. */
  readonly heightData?: HeightData | undefined;
  /**
   * A georeference made by `groma georef` for this data set: an address, a file, or its bytes. It goes before what the
   * file says; `crs` and `vertical` go before it as before the file's own. Default: none.
   */
  readonly transformation?: SourceLike | Uint8Array | undefined;
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
 * Settles the coordinate system of a data set.
 * @throws CrsError CRS_MISSING, CRS_UNKNOWN, CRS_UNSUPPORTED
 * @throws RecordError where the file's georeference record or its transformation is damaged
 * @throws SourceError SOURCE_HEIGHTS, SOURCE_EPSG where a height reference or a code needs data which cannot be had
 */
export async function georeferenceOf(
  given: PointSource,
  options: GeoreferenceOptions & OpenOptions,
): Promise<Georeference> {
  const source = await withGivenRecord(given, options);
  const { name: file, crs: declared } = source;
  const record = declared.georeference && decodeRecord(declared.georeference, file);
  const { crs: named, vertical, heightData = packagedHeights } = options;
  if (record && named === undefined && vertical === undefined) return recorded(record, source, options);
  const { wkt, geoTiff, las } = declared;
  const epsg =
    vertical === undefined ? options.epsg : await lookupFor(vertical, file, options.epsg, heightData);
  if (record && named === undefined && vertical !== undefined) {
    const { crs, notes } = crsWithHeights(record, vertical, file, epsg);
    const { transformation } = declared;
    if (transformation && sameHeights(crs, record.crs)) return recorded(record, source, options);
    if (transformation) return withOtherHeights(record, transformation, { crs, notes }, source, options);
    return fromCrs(crs, source, options, notes);
  }
  const { crs, notes } = await declaredCrs(
    {
      ...{ file, given: named, givenVertical: vertical, wkt, geoTiff, las },
      recordedHeights: record?.similarity ? undefined : record?.crs,
    },
    { epsg, epsgTable: options.epsgTable ?? packagedEpsg, heightData },
  );
  return fromCrs(crs, source, options, notes);
}

/**
 * What is known of a data set by its georeference: with the record that the application gives in place of its own.
 * @throws RecordError RECORD_* where it cannot be read or is of another file; SourceError
 */
async function withGivenRecord(
  source: PointSource,
  { transformation: given, ...options }: GeoreferenceOptions & OpenOptions,
): Promise<Declared> {
  const { name, crs, boundingBox, scale, offset, pointCount } = source;
  if (given === undefined) return source;
  const { headers, credentials, timeout, retry, signal } = options;
  const { name: file, bytes } =
    given instanceof Uint8Array
      ? { name: "transformation", bytes: given }
      : await readWhole(given, RECORD_FILE_MOST, { headers, credentials, timeout, retry, signal });
  const { of, record, transformation } = decodeRecordFile(bytes, file);
  requireSame(of, { points: pointCount, scale, offset, ...boundingBox }, name);
  const { transformation: _, ...declared } = crs;
  const georeference = encodeRecord(record);
  const own = { ...declared, georeference, ...(transformation && { transformation }) };
  return { name, boundingBox, scale, crs: own };
}

/** As the conversion settled it in plane, with the heights that the application gives. */
async function withOtherHeights(
  { engine, operation }: GeoreferenceRecord,
  bytes: Uint8Array,
  { crs, notes }: ReturnType<typeof crsWithHeights>,
  source: Declared,
  { tolerance = 0.001, heightData = packagedHeights }: GeoreferenceOptions,
): Promise<Georeference> {
  const egm96 = crs.height.kind === "geoid" ? await heightData.egm96() : undefined;
  const own = decodeTransformation(bytes, source.name);
  const map = derived({ crs, transformation: regiven(own, crs, source, egm96) }, source);
  const report = operation && operationRegiven(operation, own, crs);
  const outsideOf = await systemAbroad(map.truth, crs, source, heightData);
  const placing = { operation: report ?? UNSTATED, geoids: map.geoids, outsideOf };
  const bound = boundOf(map.truth, source, tolerance);
  const parts = accuracyParts(crs, source.scale, bound, placing);
  return {
    ...map,
    ...{ crs, basis: "given", engine, operation: report, tolerance },
    accuracy: statedAccuracy(remarked(parts, "height", [GIVEN, ...notes.map(({ text }) => text)].join("; "))),
  };
}

const UNSTATED = { name: "not stated", accuracy: null, ballpark: false };
const GIVEN = "given by the user";

/** By proj4js in the page, heights above a geoid by EGM96. */
async function fromCrs(
  crs: Crs,
  source: Declared,
  options: GeoreferenceOptions,
  notes: readonly CrsNote[] = [],
): Promise<Georeference> {
  const { crs: named, vertical, tolerance = 0.001 } = options;
  const given = named !== undefined || vertical !== undefined;
  const overruled = source.crs.georeference && source.crs.transformation;
  const whose = given ? "for the system given by the user" : "derived in the page from the file";
  const by = await transformationByEgm96(crs, source, options);
  const map = derived({ crs, ...(by.transformation && { transformation: by.transformation }) }, source);
  const { heightData = packagedHeights } = options;
  const outsideOf =
    vertical === undefined ? undefined : await systemAbroad(map.truth, crs, source, heightData);
  const there = withWorthThere(
    crs,
    map.truth,
    domainAround(source.boundingBox, source.scale, crs.horizontalUnit),
  );
  const placing = by.transformation && {
    outsideOf,
    operation: {
      name: there.datum?.operation ?? UNSTATED.name,
      accuracy: there.datum?.accuracy ?? null,
      ballpark: false,
    },
    geoids: map.geoids,
  };
  const parts = accuracyParts(there, source.scale, boundOf(map.truth, source, tolerance), placing);
  const remarks = [whose, ...notes.map(({ text }) => text), ...(overruled ? [OVERRULED] : [])];
  const told = remarked(parts, "datum operation", remarks.join("; "));
  return {
    ...map,
    ...{ crs, basis: given ? "given" : "file", engine: ENGINE, operation: undefined, tolerance },
    accuracy: statedAccuracy(by.lack === undefined ? told : remarked(told, "height", by.lack)),
  };
}

/**
 * The way to ECEF of heights above a geoid; none for others. What a file only declares is drawn without its geoid where
 * the geoid cannot be had; what the application gives is not.
 */
async function transformationByEgm96(
  crs: Crs,
  source: Declared,
  { vertical, heightData = packagedHeights }: GeoreferenceOptions,
): Promise<{ transformation?: Uint8Array; lack?: string }> {
  if (crs.height.kind !== "geoid") return {};
  try {
    return { transformation: await derivedByEgm96(crs, source, await heightData.egm96()) };
  } catch (thrown) {
    if (vertical !== undefined || !(thrown instanceof GromaError)) throw thrown;
    return { lack: thrown.cause };
  }
}

/** As the conversion settled it. */
function recorded(
  record: GeoreferenceRecord,
  source: Declared,
  { tolerance = 0.001 }: GeoreferenceOptions,
): Georeference {
  const { crs, similarity, engine, operation } = record;
  const { transformation } = source.crs;
  if (engine.name === "similarity" && !similarity) throw withoutSimilarity(source.name);
  const map = derived({ crs, similarity, transformation }, source);
  const common = { ...map, crs, basis: "record", tolerance } as const;
  const bound = boundOf(map.truth, source, tolerance);
  const lost = !transformation && !similarity && (engine.name === "PROJ" || operation !== undefined);
  if (lost) {
    const there = withWorthThere(
      crs,
      map.truth,
      domainAround(source.boundingBox, source.scale, crs.horizontalUnit),
    );
    const parts = remarked(accuracyParts(there, source.scale, bound), "datum operation", LOST);
    return { ...common, engine: ENGINE, operation: undefined, accuracy: statedAccuracy(parts) };
  }
  // The record's own fit is the converter's default; what holds here is the tolerance of this page.
  const parts = record.accuracy.map((part) => (part.name === "fit" ? { ...part, metres: bound } : part));
  return { ...common, engine, operation, accuracy: statedAccuracy(parts) };
}

/** What is stated of the drawn position, metres. */
function boundOf(truth: Truth, { name, boundingBox }: Declared, tolerance: number): number {
  const [minX, minY, minZ] = boundingBox.min;
  const [maxX, maxY, maxZ] = boundingBox.max;
  return greatestBound(truth, { minX, minY, minZ, maxX, maxY, maxZ }, tolerance, name);
}

/** The map, and what follows from it. */
function derived(
  sources: TruthSources,
  { name, boundingBox }: Declared,
): Pick<Georeference, "sources" | "truth" | "geoids"> {
  const truth = truthOf(sources, (boundingBox.min[2] + boundingBox.max[2]) / 2, name);
  const steps = typeof truth === "function" ? [] : everyStep(truth.transformation);
  const geoids = steps.flatMap((step) => (step.kind === "verticalShift" ? [step.window.grid] : []));
  return { sources, truth, geoids: [...new Set(geoids)] };
}

/** Adds to what is said of one part. */
function remarked(parts: readonly AccuracyPart[], name: string, remark: string): AccuracyPart[] {
  return parts.map((part) => {
    if (part.name !== name) return part;
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
