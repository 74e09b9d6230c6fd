import { FormatError } from "../../errors/index.js";
import type { ByteSource, ReadOptions } from "../bytes/byte-source.js";
import { type LasHeader, readText, readU64, truncated } from "./las-header.js";

/** Length of a VLR's header in bytes (LAS 1.4 R15, section 2.5). */
export const VLR_HEADER = 54;
/** Length of an extended VLR's header in bytes (LAS 1.4 R15, section 2.6). */
export const EVLR_HEADER = 60;
/** More records than any writer makes: a count above it is taken for damage, not walked. */
const MAX_RECORDS = 4096;
/** Bytes of one record's content that are read at most; WKT and statistics take a few kilobytes. */
const MAX_CONTENT = 16 * 1024 * 1024;

/** Where the content of a variable length record lies. */
export interface VlrEntry {
  readonly userId: string;
  readonly recordId: number;
  /** First byte of the content, from the file's start. */
  readonly begin: number;
  /** Byte after the content. */
  readonly end: number;
}

/**
 * Walks the VLRs between header and points.
 * @param bytes the file from its start to {@link LasHeader.pointsOffset}
 * @throws FormatError FORMAT_VLR where a record would reach into the points
 */
export function walkVlrs(
  bytes: Uint8Array,
  header: LasHeader,
  headerLength: number,
  file: string,
): VlrEntry[] {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const entries: VlrEntry[] = [];
  let at = headerLength;
  for (let index = 0; index < Math.min(header.vlrCount, MAX_RECORDS); index++) {
    if (at + VLR_HEADER > header.pointsOffset) throw badVlr(file, index);
    const begin = at + VLR_HEADER;
    const end = begin + view.getUint16(at + 20, true);
    if (end > header.pointsOffset) throw badVlr(file, index);
    entries.push({
      userId: readText(bytes, at + 2, 16),
      recordId: view.getUint16(at + 18, true),
      begin,
      end,
    });
    at = end;
  }
  return entries;
}

/**
 * Walks the extended VLRs behind the points; each header is one small read, contents are not fetched.
 * @throws FormatError FORMAT_TRUNCATED, FORMAT_VLR
 */
export async function walkEvlrs(
  source: ByteSource,
  header: LasHeader,
  options: ReadOptions,
): Promise<VlrEntry[]> {
  const entries: VlrEntry[] = [];
  if (header.evlrOffset === 0) return entries;
  let at = header.evlrOffset;
  for (let index = 0; index < Math.min(header.evlrCount, MAX_RECORDS); index++) {
    if (source.size !== undefined && at + EVLR_HEADER > source.size) {
      throw truncated(source.name, "its extended records");
    }
    const entry = evlrEntry(await source.read(at, at + EVLR_HEADER, options), at, source.name);
    if (source.size !== undefined && entry.end > source.size) {
      throw truncated(source.name, "its extended records");
    }
    entries.push(entry);
    at = entry.end;
  }
  return entries;
}

/**
 * The extended VLR whose header begins with `bytes`, which stand at byte `at` of the file.
 * @throws FormatError where its length is beyond what a number holds
 */
export function evlrEntry(bytes: Uint8Array, at: number, file: string): VlrEntry {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const begin = at + EVLR_HEADER;
  const end = begin + readU64(view, 20, file);
  return { userId: readText(bytes, 2, 16), recordId: view.getUint16(18, true), begin, end };
}

/** First record with the ids given, or undefined. */
export function findVlr(
  entries: readonly VlrEntry[],
  userId: string,
  recordId: number,
): VlrEntry | undefined {
  return entries.find((entry) => entry.userId === userId && entry.recordId === recordId);
}

/**
 * Content of a record; undefined where there is no such record or its content is empty.
 * @throws FormatError FORMAT_VLR where it is absurdly long
 */
export async function readVlr(
  source: ByteSource,
  entry: VlrEntry | undefined,
  options: ReadOptions,
): Promise<Uint8Array | undefined> {
  if (!entry || entry.end === entry.begin) return undefined;
  if (entry.end - entry.begin > MAX_CONTENT) {
    throw new FormatError({
      code: "FORMAT_VLR",
      file: source.name,
      cause: `record ${entry.userId} ${entry.recordId} claims ${entry.end - entry.begin} bytes`,
      fix: "Write the file again with a conforming tool",
    });
  }
  return source.read(entry.begin, entry.end, options);
}

function badVlr(file: string, index: number): FormatError {
  return new FormatError({
    code: "FORMAT_VLR",
    file,
    cause: `variable length record ${index} reaches into the points`,
    fix: "Write the file again with a conforming tool",
  });
}
