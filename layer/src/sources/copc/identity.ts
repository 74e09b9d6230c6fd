import { crc32c } from "../contract/checksum.js";
import type { LasHeader } from "../las/las-header.js";
import { ENTRY_LENGTH } from "./hierarchy.js";

/** Bytes of the first page that are looked at: 4,096 nodes tell scans apart. */
const MOST = ENTRY_LENGTH * 4096;

/** Where the offset of a chunk stands in an entry, and how long it is (copc.io, "hierarchy VLR"). */
const OFFSET = { at: 16, length: 8 };

/**
 * What tells the points of a file from those of others, whatever it is called: their number, and a CRC-32C of the scale,
 * offset and bounds in the header and of the keys, numbers of points and compressed lengths of the nodes in the first page.
 * Where chunks stand in the file has no part in it, so a file that is given another georeference keeps its own.
 * @param page the first page of the hierarchy
 * @returns as `116809-09f3a1c2`
 */
export function identityOf({ pointCount, scale, offset, min, max }: LasHeader, page: Uint8Array): string {
  const numbers = new DataView(new ArrayBuffer(8 * 12));
  for (const [i, value] of [...scale, ...offset, ...min, ...max].entries()) {
    // Of a zero the sign tells nothing.
    numbers.setFloat64(8 * i, value + 0, true);
  }
  const entries = page.slice(0, MOST);
  for (let at = OFFSET.at; at < entries.length; at += ENTRY_LENGTH) entries.fill(0, at, at + OFFSET.length);
  const bytes = new Uint8Array(numbers.byteLength + entries.length);
  bytes.set(new Uint8Array(numbers.buffer));
  bytes.set(entries, numbers.byteLength);
  return `${pointCount}-${crc32c(bytes).toString(16).padStart(8, "0")}`;
}
