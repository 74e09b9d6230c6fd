import { requireKind } from "../errors/arguments.js";
import { RecordError } from "../errors/errors.js";
import { FieldError, readRecord } from "./fields.js";
import type { GeoreferenceRecord } from "./georeference-record.js";

/** A record is a few kilobytes; what is longer than the longest VLR payload is something else. */
const LONGEST = 65535;

/**
 * The bytes of the VLR's payload.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function encodeRecord(record: GeoreferenceRecord): Uint8Array {
  requireKind(record, "object", "encodeRecord: record");
  return new TextEncoder().encode(JSON.stringify(record));
}

/**
 * Reads the payload of the VLR and checks every member: bytes of a file are not to be trusted.
 *
 * @param file name for error messages
 * @throws RecordError RECORD_SIZE (longer than a VLR can be), RECORD_JSON (not UTF-8 JSON), RECORD_VERSION (of a
 *   later version), RECORD_FIELD (a member is missing or is not what it should be)
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function decodeRecord(bytes: Uint8Array, file: string): GeoreferenceRecord {
  requireKind(bytes, "bytes", "decodeRecord: bytes");
  if (bytes.length > LONGEST) throw refusal("RECORD_SIZE", file, `it is ${bytes.length} bytes long`);
  let json: unknown;
  try {
    const text = new TextDecoder("utf-8", { fatal: true }).decode(bytes);
    json = JSON.parse(text.replace(/\0+$/, ""));
  } catch {
    throw refusal("RECORD_JSON", file, "it is not JSON in UTF-8");
  }
  try {
    return readRecord(json);
  } catch (error) {
    if (!(error instanceof FieldError)) throw error;
    throw refusal(error.member === "version" ? "RECORD_VERSION" : "RECORD_FIELD", file, error.message);
  }
}

function refusal(code: string, file: string, cause: string): RecordError {
  return new RecordError({
    ...{ code, file, cause: `the georeference record of Groma cannot be read: ${cause}` },
    fix: "convert the scan again, or open the file with its coordinate reference system given",
  });
}
