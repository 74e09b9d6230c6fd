import {
  type AccuracyPart,
  accuracyParts,
  type Crs,
  type CrsNote,
  decodeTransformation,
  domainAround,
  ENGINE,
  type GeoreferenceRecord,
  GromaError,
  sameHeights,
  statedAccuracy,
  type TruthSources,
  truthOf,
  withWorthThere,
} from "@groma/georef";
import { declaredCrs, packagedEpsg } from "./declared-crs.js";
import type { Georeference, GeoreferenceOptions } from "./georeference-options.js";
import { packagedHeights } from "./height-data.js";
import {
  crsWithHeights,
  derivedByEgm96,
  lookupFor,
  operationRegiven,
  regiven,
  systemAbroad,
} from "./heights.js";
import { boundOf, type Declared, mapOf, recorded, similarityOf } from "./recorded-georeference.js";

/** Said where the file carries a transformation that the application's word takes out of force. */
const OVERRULED = "the transformation that the conversion put into the file is not used";
/** Said where the record speaks of a transformation that the file has lost. */
const LOST = "the transformation of the conversion is no longer in the file; derived in the page by proj4js";

/**
 * Where a data set lies whose record alone does not say it: by its CRS and proj4js, and by the transformation of the
 * conversion with other heights.
 * @throws as `georeferenceOf`
 */
export async function derivedGeoreference(
  record: GeoreferenceRecord | undefined,
  source: Declared,
  options: GeoreferenceOptions,
): Promise<Georeference> {
  const { name: file, crs: declared } = source;
  const { crs: named, vertical, heightData = packagedHeights } = options;
  if (record && named === undefined && vertical === undefined) return byRecordedCrs(record, source, options);
  const { wkt, geoTiff, las } = declared;
  const epsg =
    vertical === undefined ? options.epsg : await lookupFor(vertical, file, options.epsg, heightData);
  if (record && named === undefined && vertical !== undefined) {
    const { crs, notes } = crsWithHeights(record, vertical, file, epsg);
    const { transformation } = declared;
    if (transformation && sameHeights(crs, record.crs)) return byRecordedCrs(record, source, options);
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

/** As the conversion settled it; by proj4js where the file has lost the transformation. */
function byRecordedCrs(
  record: GeoreferenceRecord,
  source: Declared,
  options: GeoreferenceOptions,
): Georeference {
  const { tolerance = 0.001 } = options;
  const { crs, engine, operation } = record;
  const similarity = similarityOf(record, source.name);
  const { transformation } = source.crs;
  const map = derived({ crs, similarity, transformation }, source);
  const { truth } = map;
  const lost = !transformation && !similarity && (engine.name === "PROJ" || operation !== undefined);
  if (!lost) return recorded(record, truth, source, options);
  const there = withWorthThere(
    crs,
    truth,
    domainAround(source.boundingBox, source.scale, crs.horizontalUnit),
  );
  const bound = boundOf(truth, source, tolerance);
  const parts = remarked(accuracyParts(there, source.scale, bound), "datum operation", LOST);
  return {
    ...map,
    ...{ crs, basis: "record", tolerance, engine: ENGINE, operation: undefined },
    accuracy: statedAccuracy(parts),
  };
}

/** The map of what is known, and what follows from it. */
function derived(sources: TruthSources, { name, boundingBox }: Declared): ReturnType<typeof mapOf> {
  return mapOf(sources, truthOf(sources, (boundingBox.min[2] + boundingBox.max[2]) / 2, name));
}

/** Adds to what is said of one part. */
function remarked(parts: readonly AccuracyPart[], name: string, remark: string): AccuracyPart[] {
  return parts.map((part) => {
    if (part.name !== name) return part;
    return { ...part, note: part.note ? `${part.note}; ${remark}` : remark };
  });
}
