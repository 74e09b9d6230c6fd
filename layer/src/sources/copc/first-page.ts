import { readU64 } from "../las/las-header.js";
import type { CopcInfo } from "./copc-info.js";
import { ENTRY_LENGTH } from "./hierarchy.js";

/** Bytes before the entries: version, number, byte of the root page. */
const HEADER = 16;

/** The only version that there is. */
const VERSION = 1;

/** Bytes of a checksum. */
const CHECKSUM = 4;

/** The root page of the hierarchy as it comes with the header. */
export interface FirstPage {
  readonly bytes: Uint8Array;
  /** CRC-32C of each entry's chunk; undefined where the file has none, or they are read elsewhere. */
  readonly checksums: Uint32Array | undefined;
}

/**
 * The copy of the root page that Groma puts before the points (record 5, docs/record.md).
 * @param record its content
 * @returns undefined where it was made for another file, or by a version that is not known
 */
export function copiedPage(record: Uint8Array, { rootPage }: CopcInfo, file: string): FirstPage | undefined {
  if (record.length < HEADER) return undefined;
  const view = new DataView(record.buffer, record.byteOffset, record.byteLength);
  const count = view.getUint32(4, true);
  const isOwn =
    view.getUint32(0, true) === VERSION &&
    readU64(view, 8, file) === rootPage.offset &&
    count * ENTRY_LENGTH === rootPage.length &&
    record.length === HEADER + count * (ENTRY_LENGTH + CHECKSUM);
  if (!isOwn) return undefined;
  const end = HEADER + rootPage.length;
  const checksums = Uint32Array.from({ length: count }, (_, index) =>
    view.getUint32(end + CHECKSUM * index, true),
  );
  return { bytes: record.slice(HEADER, end), checksums };
}
