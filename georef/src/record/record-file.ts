import { requireFields, requireKind } from "../errors/arguments.js";
import { RecordError } from "../errors/errors.js";
import { FieldError, readNumbers, readObject, readRecord } from "./fields.js";
import type { GeoreferenceRecord } from "./georeference-record.js";

/** By what a data set is known again: what its header says, source units. */
export interface DataSetIdentity {
  readonly points: number;
  /** Source units per step of the integers, and their offset, per axis. */
  readonly scale: readonly [number, number, number];
  readonly offset: readonly [number, number, number];
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

/** A georeference that stands beside its data set, whose file cannot be rewritten. */
export interface RecordFile {
  /** The data set that it is of: nowhere else does it hold. */
  readonly of: DataSetIdentity;
  readonly record: GeoreferenceRecord;
  /** Payload of the VLR `groma`/3; absent where none is needed. */
  readonly transformation?: Uint8Array | undefined;
}

/** Bytes: a country with its grids takes 0.2 MB. */
export const RECORD_FILE_MOST = 64 * 1024 * 1024;
/** What its member `groma` says. */
const KIND = "georeference";
/** Characters at a time: a call has no more arguments than that. */
const CHUNK = 0x8000;

/**
 * JSON in UTF-8, as docs/record.md describes it.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function encodeRecordFile(recordFile: RecordFile): Uint8Array {
  requireFields(
    recordFile,
    { of: "object", record: "object", transformation: "bytes?" },
    "encodeRecordFile: recordFile",
  );
  const { of, record, transformation } = recordFile;
  const json = {
    ...{ groma: KIND, version: 1, of, record },
    ...(transformation && { transformation: toBase64(transformation) }),
  };
  return new TextEncoder().encode(`${JSON.stringify(json)}\n`);
}

/**
 * Reads such a file and checks every member.
 *
 * @param file name for error messages
 * @throws RecordError RECORD_SIZE, RECORD_JSON, RECORD_VERSION, RECORD_FIELD
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function decodeRecordFile(bytes: Uint8Array, file: string): RecordFile {
  requireKind(bytes, "bytes", "decodeRecordFile: bytes");
  if (bytes.length > RECORD_FILE_MOST) throw refusal("RECORD_SIZE", file, `it is ${bytes.length} bytes long`);
  let json: unknown;
  try {
    json = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes));
  } catch {
    throw refusal("RECORD_JSON", file, "it is not JSON in UTF-8");
  }
  try {
    return readFile(json);
  } catch (error) {
    if (!(error instanceof FieldError)) throw error;
    throw refusal(error.member === "version" ? "RECORD_VERSION" : "RECORD_FIELD", file, error.message);
  }
}

function readFile(json: unknown): RecordFile {
  const whole = readObject(json, "the file");
  if (whole.groma !== KIND) throw new FieldError("groma", `"${KIND}"`);
  if (whole.version !== 1) throw new FieldError("version", "1, the only one that is known");
  const of = readObject(whole.of, "of");
  const triple = (name: string): [number, number, number] => {
    const [x, y, z] = readNumbers(of[name], `of.${name}`, 3);
    return [x, y, z];
  };
  const [points] = readNumbers([of.points], "of.points", 1);
  const record = readRecord(whole.record);
  return {
    of: { points, scale: triple("scale"), offset: triple("offset"), min: triple("min"), max: triple("max") },
    record,
    ...(whole.transformation === undefined ? {} : { transformation: fromBase64(whole.transformation) }),
  };
}

/**
 * Whether a data set is the one that a record was made for.
 * @throws RecordError RECORD_OTHER
 */
export function requireSame(of: DataSetIdentity, dataSet: DataSetIdentity, file: string): void {
  const differs = (name: keyof DataSetIdentity) => String(of[name]) !== String(dataSet[name]);
  const name = (["points", "scale", "offset", "min", "max"] as const).find(differs);
  if (name === undefined) return;
  const what = { points: "number of points", scale: "scale", offset: "offset", min: "bounds", max: "bounds" }[
    name
  ];
  throw new RecordError({
    code: "RECORD_OTHER",
    file,
    cause: `the georeference that was given is of another file: the ${what} differs`,
    fix: "make it again from this file with groma georef",
  });
}

function toBase64(bytes: Uint8Array): string {
  let text = "";
  for (let at = 0; at < bytes.length; at += CHUNK) {
    text += String.fromCharCode(...bytes.subarray(at, at + CHUNK));
  }
  return btoa(text);
}

function fromBase64(given: unknown): Uint8Array {
  try {
    if (typeof given === "string")
      return Uint8Array.from(atob(given), (character) => character.charCodeAt(0));
  } catch {
    // Said below, like everything else that is no base64.
  }
  throw new FieldError("transformation", "base64");
}

function refusal(code: string, file: string, cause: string): RecordError {
  return new RecordError({
    ...{ code, file, cause: `the georeference of Groma cannot be read: ${cause}` },
    fix: "make it again with groma georef",
  });
}
