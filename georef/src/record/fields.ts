import type { Crs, DatumOperation, HeightReference, Unit } from "../crs/crs.js";
import type { Similarity } from "../engines/truth.js";
import type { AccuracyPart } from "./accuracy.js";
import type { GeoreferenceRecord } from "./georeference-record.js";
import type { OperationReport } from "./operation-report.js";

/** A member of the record that is not what it should be. */
export class FieldError extends Error {
  readonly member: string;

  constructor(member: string, what: string) {
    super(`${member} is not ${what}`);
    this.member = member;
  }
}

type Json = Readonly<Record<string, unknown>>;

/** Longest text that a member may have; a WKT has a few thousand characters. */
const LONGEST_TEXT = 60000;
/** Most items that a list of the record may have. */
const MOST_PARTS = 100;

const ENGINES = ["PROJ", "proj4js", "similarity"] as const;

/** The record in a JSON value, member by member. @throws FieldError */
export function readRecord(json: unknown): GeoreferenceRecord {
  const record = readObject(json, "the record");
  if (record.version !== 1) throw new FieldError("version", "1, the only one that is known");
  const engine = readObject(record.engine, "engine");
  const name = ENGINES.find((known) => known === engine.name);
  if (!name) throw new FieldError("engine.name", `one of ${ENGINES.join(", ")}`);
  return {
    version: 1,
    crs: readCrs(readObject(record.crs, "crs")),
    engine: { name, version: text(engine.version, "engine.version") },
    ...(record.operation === undefined
      ? {}
      : { operation: readOperation(readObject(record.operation, "operation")) }),
    ...(record.similarity === undefined
      ? {}
      : { similarity: readSimilarity(readObject(record.similarity, "similarity")) }),
    accuracy: readAccuracy(record.accuracy),
  };
}

function readCrs(crs: Json): Crs {
  const declared = readObject(crs.verticalUnit, "crs.verticalUnit").declared;
  if (typeof declared !== "boolean") throw new FieldError("crs.verticalUnit.declared", "true or false");
  const proj4 = text(crs.proj4, "crs.proj4");
  if (!/^\+proj=[a-z]/.test(proj4)) throw new FieldError("crs.proj4", "a PROJ string");
  const verticalUnit = readUnit(crs.verticalUnit, "crs.verticalUnit", "either way");
  if (verticalUnit.kind !== "linear") throw new FieldError("crs.verticalUnit.kind", '"linear"');
  return {
    name: text(crs.name, "crs.name"),
    ...(crs.code === undefined ? {} : { code: text(crs.code, "crs.code") }),
    proj4,
    ...(crs.wkt === undefined ? {} : { wkt: text(crs.wkt, "crs.wkt") }),
    horizontalUnit: readUnit(crs.horizontalUnit, "crs.horizontalUnit"),
    verticalUnit: { ...verticalUnit, declared },
    height: readHeight(readObject(crs.height, "crs.height")),
    ...(crs.datum === undefined ? {} : { datum: readDatum(readObject(crs.datum, "crs.datum")) }),
  };
}

function readUnit(value: unknown, member: string, counts: "up" | "either way" = "up"): Unit {
  const unit = readObject(value, member);
  if (unit.kind !== "linear" && unit.kind !== "angular")
    throw new FieldError(`${member}.kind`, "linear or angular");
  const size = number(unit.size, `${member}.size`);
  // From a nanometre to a light second: beyond that it is no unit of a scan.
  const length = counts === "up" ? size : Math.abs(size);
  if (!(length > 1e-9 && length < 3e8)) throw new FieldError(`${member}.size`, "the size of a unit");
  return { name: text(unit.name, `${member}.name`), kind: unit.kind, size };
}

function readHeight(height: Json): HeightReference {
  if (height.kind === "unknown") return { kind: height.kind };
  const doubt = height.doubt === undefined ? {} : { doubt: text(height.doubt, "crs.height.doubt") };
  if (height.kind === "ellipsoidal") {
    if (height.ellipsoid === undefined) return { kind: height.kind, ...doubt };
    if (height.ellipsoid !== "own") throw new FieldError("crs.height.ellipsoid", "own");
    return { kind: height.kind, ellipsoid: height.ellipsoid, ...doubt };
  }
  if (height.kind !== "geoid") throw new FieldError("crs.height.kind", "ellipsoidal, geoid or unknown");
  const geoid = { kind: "geoid", model: text(height.model, "crs.height.model"), ...doubt } as const;
  if (height.epsg === undefined) return geoid;
  return { ...geoid, epsg: epsgCode(height.epsg, "crs.height.epsg") };
}

function epsgCode(value: unknown, member: string): number {
  const code = number(value, member);
  if (!Number.isInteger(code) || code <= 0) throw new FieldError(member, "an EPSG code");
  return code;
}

function readDatum(datum: Json): DatumOperation {
  const read = {
    operation: text(datum.operation, "crs.datum.operation"),
    accuracy: metresOrNull(datum.accuracy, "crs.datum.accuracy"),
  };
  return datum.datum === undefined ? read : { ...read, datum: epsgCode(datum.datum, "crs.datum.datum") };
}

function readOperation(operation: Json): OperationReport {
  const { ballpark } = operation;
  if (typeof ballpark !== "boolean") throw new FieldError("operation.ballpark", "true or false");
  const lacking = list(operation.lacking, "operation.lacking").map((item, i) => {
    const member = `operation.lacking[${i}]`;
    const better = readObject(item, member);
    return {
      name: text(better.name, `${member}.name`),
      accuracy: metresOrNull(better.accuracy, `${member}.accuracy`),
      grids: texts(better.grids, `${member}.grids`),
    };
  });
  return {
    name: text(operation.name, "operation.name"),
    accuracy: metresOrNull(operation.accuracy, "operation.accuracy"),
    ballpark,
    grids: texts(operation.grids, "operation.grids"),
    lacking,
    worstDifference: metresOrNull(operation.worstDifference, "operation.worstDifference"),
    notes: texts(operation.notes, "operation.notes"),
  };
}

function readSimilarity(similarity: Json): Similarity {
  const [x, y, z] = readNumbers(similarity.translation, "similarity.translation", 3);
  return { translation: [x, y, z], matrix: readNumbers(similarity.matrix, "similarity.matrix", 9) };
}

/** @throws FieldError */
export function readNumbers(value: unknown, member: string, count: number): number[] {
  const values = list(value, member);
  if (values.length !== count) throw new FieldError(member, `${count} numbers`);
  return values.map((item, i) => number(item, `${member}[${i}]`));
}

function readAccuracy(value: unknown): AccuracyPart[] {
  return list(value, "accuracy").map((item, i) => {
    const member = `accuracy[${i}]`;
    const part = readObject(item, member);
    const note = part.note === undefined ? {} : { note: text(part.note, `${member}.note`) };
    const name = text(part.name, `${member}.name`);
    return { name, metres: metresOrNull(part.metres, `${member}.metres`), ...note };
  });
}

/** @throws FieldError */
export function readObject(value: unknown, member: string): Json {
  if (typeof value === "object" && value !== null && !Array.isArray(value)) return value as Json;
  throw new FieldError(member, "an object");
}

function list(value: unknown, member: string): readonly unknown[] {
  if (Array.isArray(value) && value.length <= MOST_PARTS) return value;
  throw new FieldError(member, "a short list");
}

function texts(value: unknown, member: string): string[] {
  return list(value, member).map((item, i) => text(item, `${member}[${i}]`));
}

function text(value: unknown, member: string): string {
  if (typeof value === "string" && value.length <= LONGEST_TEXT) return value;
  throw new FieldError(member, "a text");
}

function number(value: unknown, member: string): number {
  if (typeof value === "number" && Number.isFinite(value)) return value;
  throw new FieldError(member, "a number");
}

function metresOrNull(value: unknown, member: string): number | null {
  if (value === null) return null;
  const metres = number(value, member);
  if (metres < 0) throw new FieldError(member, "metres or null");
  return metres;
}
