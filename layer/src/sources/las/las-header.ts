import { FormatError } from "../../errors/index.js";

/** Length of the LAS 1.4 public header block in bytes (LAS 1.4 R15, section 2.4). */
const LAS_HEADER_LENGTH = 375;

/** The parts of the LAS 1.4 public header block that the layer uses. */
export interface LasHeader {
  readonly systemIdentifier: string;
  readonly generatingSoftware: string;
  /** Bit 4 of the global encoding: the coordinate reference system is declared as WKT (LAS 1.4 R15, 2.4). */
  readonly wktBit: boolean;
  /** Offset of the first point data, in bytes from the file's start. */
  readonly pointsOffset: number;
  readonly vlrCount: number;
  /** Offset of the first extended VLR; 0 where there is none. */
  readonly evlrOffset: number;
  readonly evlrCount: number;
  /** Point data record format without the compression bits: 6, 7 or 8 in COPC. */
  readonly pointFormat: number;
  /** Bytes per uncompressed record, extra bytes included. */
  readonly recordLength: number;
  readonly pointCount: number;
  /** Source units per integer step, per axis. */
  readonly scale: readonly [number, number, number];
  /** Source units added after scaling, per axis. */
  readonly offset: readonly [number, number, number];
  /** Least coordinates as declared, source units: whatever the writer put there, numbers or not. */
  readonly min: readonly [number, number, number];
  /** Greatest coordinates as declared, source units. */
  readonly max: readonly [number, number, number];
}

/** Bytes of an uncompressed record of formats 6, 7 and 8 without extra bytes (LAS 1.4 R15, tables 15 to 17). */
export const BASE_RECORD_LENGTH: Readonly<Record<number, number>> = { 6: 30, 7: 36, 8: 38 };

/**
 * Reads the public header block of a COPC file's LAS 1.4.
 * @param bytes at least {@link LAS_HEADER_LENGTH} bytes from the file's start
 * @throws FormatError FORMAT_MAGIC, FORMAT_TRUNCATED, FORMAT_NOT_COPC, FORMAT_EMPTY, FORMAT_HEADER
 */
export function parseLasHeader(bytes: Uint8Array, file: string): LasHeader {
  checkMagic(bytes, file);
  const version = `${bytes[24]}.${bytes[25]}`;
  const other = () => notCopc(file, `this is LAS ${version}; COPC is LAS 1.4`);
  // Whole files of other versions may be shorter than this header.
  if (bytes.length > 25 && version !== "1.4") throw other();
  if (bytes.length < LAS_HEADER_LENGTH) throw truncated(file, "the header");
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const formatByte = view.getUint8(104);
  const pointFormat = formatByte & 0x3f;
  if (view.getUint16(94, true) < LAS_HEADER_LENGTH) throw other();
  if (!(pointFormat in BASE_RECORD_LENGTH) || (formatByte & 0x80) === 0) {
    throw notCopc(file, `its point format is ${formatByte}; COPC has compressed format 6, 7 or 8`);
  }
  const header: LasHeader = {
    wktBit: (view.getUint16(6, true) & 0x10) !== 0,
    systemIdentifier: readText(bytes, 26, 32),
    generatingSoftware: readText(bytes, 58, 32),
    pointsOffset: view.getUint32(96, true),
    vlrCount: view.getUint32(100, true),
    evlrOffset: readU64(view, 235, file),
    evlrCount: view.getUint32(243, true),
    pointFormat,
    recordLength: view.getUint16(105, true),
    pointCount: readU64(view, 247, file),
    scale: [131, 139, 147].map((at) => view.getFloat64(at, true)) as [number, number, number],
    offset: [155, 163, 171].map((at) => view.getFloat64(at, true)) as [number, number, number],
    min: [187, 203, 219].map((at) => view.getFloat64(at, true)) as [number, number, number],
    max: [179, 195, 211].map((at) => view.getFloat64(at, true)) as [number, number, number],
  };
  checkHeader(header, file);
  return header;
}

function checkMagic(bytes: Uint8Array, file: string): void {
  if (readText(bytes, 0, 4) === "LASF") return;
  throw new FormatError({
    code: "FORMAT_MAGIC",
    file,
    cause: "it does not begin with LASF: this is not a LAS, LAZ or COPC file",
    fix: "Check the address or choose another file",
  });
}

function checkHeader(header: LasHeader, file: string): void {
  if (header.pointCount === 0) {
    throw new FormatError({
      code: "FORMAT_EMPTY",
      file,
      cause: "it holds no points",
      fix: "Check the step that wrote the file",
    });
  }
  const invalid = (what: string) => badHeader(file, what);
  if (header.recordLength < BASE_RECORD_LENGTH[header.pointFormat]) throw invalid("record length");
  if (header.scale.some((scale) => !Number.isFinite(scale) || scale <= 0)) throw invalid("scale");
  if (header.offset.some((offset) => !Number.isFinite(offset))) throw invalid("offset");
}

/**
 * Fixed-length text of a LAS header or VLR: ends at the first NUL, trailing blanks dropped. LAS 1.4 R15 table 3 asks for
 * ASCII; what is neither that nor UTF-8 is read as Latin-1, byte by byte, as the converter reads it.
 */
export function readText(bytes: Uint8Array, at: number, length: number): string {
  const field = bytes.subarray(at, at + length);
  const end = field.indexOf(0);
  const text = end < 0 ? field : field.subarray(0, end);
  try {
    return new TextDecoder("utf-8", { fatal: true, ignoreBOM: true }).decode(text).trimEnd();
  } catch {
    return String.fromCharCode(...text).trimEnd();
  }
}

/**
 * A 64-bit unsigned little-endian integer as a number.
 * @throws FormatError FORMAT_HEADER above 2^53, beyond any real file
 */
export function readU64(view: DataView, at: number, file: string): number {
  const value = Number(view.getBigUint64(at, true));
  if (!Number.isSafeInteger(value)) throw badHeader(file, `64-bit number at byte ${at}`);
  return value;
}

/** The error for a LAS or LAZ file that is no COPC. */
export function notCopc(file: string, cause: string): FormatError {
  return new FormatError({
    code: "FORMAT_NOT_COPC",
    file,
    cause,
    fix: "Convert it: groma convert IN OUT.copc.laz",
  });
}

/** The error for a file that ends before something it announces. */
export function truncated(file: string, what: string): FormatError {
  return new FormatError({
    code: "FORMAT_TRUNCATED",
    file,
    cause: `the file ends within ${what}`,
    fix: "Copy or convert the file again",
  });
}

/** The error for a header field that no reader could use. */
export function badHeader(file: string, what: string): FormatError {
  return new FormatError({
    code: "FORMAT_HEADER",
    file,
    cause: `the header's ${what} is not usable`,
    fix: "Write the file again with a conforming tool",
  });
}
