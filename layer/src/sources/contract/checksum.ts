import { DecodeError } from "../../errors/index.js";

/** Checks of 32 bits that are reflected, as both of these are: Castagnoli's (RFC 3720, appendix B.4) and that of ZIP and PNG. */
const CASTAGNOLI = 0x82f6_3b78;
const IEEE = 0xedb8_8320;

/**
 * Eight tables of 256: number k tells what a byte does to the checksum that k more bytes follow, so that eight bytes
 * are looked up at once ("slicing-by-8": Kounavis and Berry 2008).
 */
function makeTables(polynomial: number): Int32Array[] {
  const tables = Array.from({ length: 8 }, () => new Int32Array(256));
  for (let byte = 0; byte < 256; byte++) {
    let value = byte;
    for (let bit = 0; bit < 8; bit++) value = (value >>> 1) ^ (value & 1 ? polynomial : 0);
    tables[0]![byte] = value;
  }
  for (let table = 1; table < 8; table++) {
    for (let byte = 0; byte < 256; byte++) {
      const before = tables[table - 1]![byte]!;
      tables[table]![byte] = (before >>> 8) ^ tables[0]![before & 255]!;
    }
  }
  return tables;
}

/** @param before checksum of the bytes that come before these; 0: none do */
type Checksum = (bytes: Uint8Array, before?: number) => number;

function checksumBy(polynomial: number): Checksum {
  const [t0, t1, t2, t3, t4, t5, t6, t7] = makeTables(polynomial) as [
    ...[Int32Array, Int32Array, Int32Array, Int32Array],
    ...[Int32Array, Int32Array, Int32Array, Int32Array],
  ];
  return (bytes, before = 0) => {
    let crc = ~before;
    let at = 0;
    for (const end = bytes.length - 7; at < end; at += 8) {
      const low =
        crc ^ (bytes[at]! | (bytes[at + 1]! << 8) | (bytes[at + 2]! << 16) | (bytes[at + 3]! << 24));
      crc =
        t7[low & 255]! ^
        t6[(low >>> 8) & 255]! ^
        t5[(low >>> 16) & 255]! ^
        t4[low >>> 24]! ^
        t3[bytes[at + 4]!]! ^
        t2[bytes[at + 5]!]! ^
        t1[bytes[at + 6]!]! ^
        t0[bytes[at + 7]!]!;
    }
    for (; at < bytes.length; at++) crc = (crc >>> 8) ^ t0[(crc ^ bytes[at]!) & 255]!;
    return ~crc >>> 0;
  };
}

/** The CRC-32C of some bytes as an unsigned number. A megabyte takes about a millisecond. */
export const crc32c = checksumBy(CASTAGNOLI);

/** The CRC-32 of some bytes, as ZIP has it. */
export const crc32 = checksumBy(IEEE);

/**
 * Holds a chunk against its checksum. Damaged points often decode to others, which must neither be drawn nor measured.
 * @param checksum as stored; undefined where there is none, and then nothing is checked
 * @throws DecodeError DECODE_CHECKSUM
 */
export function checkChecksum(
  bytes: Uint8Array,
  checksum: number | undefined,
  { file, node }: { readonly file: string; readonly node: string },
): void {
  if (checksum === undefined) return;
  const found = crc32c(bytes);
  if (found === checksum) return;
  const hex = (value: number) => value.toString(16).padStart(8, "0");
  throw new DecodeError({
    code: "DECODE_CHECKSUM",
    file,
    cause: `the points of node ${node} are damaged: their checksum is ${hex(found)}, ${hex(checksum)} is stored`,
    fix: "Copy or download the file again, or convert the scan again",
  });
}
