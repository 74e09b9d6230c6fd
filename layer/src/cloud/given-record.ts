import { decodeRecordFile, encodeRecord, RECORD_FILE_MOST, requireSame } from "@groma/georef";
import type { PointSource } from "../sources/contract/point-source.js";
import { type OpenOptions, readWhole, type SourceLike } from "../sources/open-source.js";
import type { Declared } from "./recorded-georeference.js";

/**
 * What is known of a data set by its georeference: with the record that the application gives in place of its own.
 * @throws RecordError RECORD_* where it cannot be read or is of another file; SourceError
 */
export async function withGivenRecord(
  source: PointSource,
  given: SourceLike | Uint8Array,
  options: OpenOptions,
): Promise<Declared> {
  const { name, crs, boundingBox, scale, offset, pointCount } = source;
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
