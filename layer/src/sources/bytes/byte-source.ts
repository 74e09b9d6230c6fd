import { SourceError } from "../../errors/index.js";
import type { ServerWait } from "./host-schedule.js";

/** Options of every read. */
export interface ReadOptions {
  /** Stops the read; it then rejects with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
}

/**
 * Random access to the bytes of one file. The only I/O the layer knows: formats are parsed on top of it,
 * so an application can bring its own (an archive member, a cache, a decrypting proxy).
 */
export interface ByteSource {
  /** What errors call the file: its address or name. */
  readonly name: string;
  /** Length of the file in bytes; absent where the server hides it (no exposed `Content-Range`). */
  readonly size?: number | undefined;
  /** Why the bytes are waited for, and until when, where a server cannot serve for now. */
  readonly wait?: ServerWait | undefined;
  /**
   * Bytes `begin` (inclusive) to `end` (exclusive), exactly `end − begin` of them.
   * @throws SourceError when they cannot be had; with an `outage` where asking again later may help: what a view wants
   * is then asked for again by itself.
   */
  read(begin: number, end: number, options?: ReadOptions): Promise<Uint8Array>;
}

/** True for what looks like a {@link ByteSource} rather than an address or a Blob. */
export function isByteSource(value: unknown): value is ByteSource {
  return typeof value === "object" && value !== null && "read" in value && typeof value.read === "function";
}

/**
 * Holds a wanted range against the file before anything is asked for: an empty or negative range would make
 * `bytes=0--1`, which servers answer with the whole file.
 * @throws SourceError SOURCE_RANGE
 */
export function checkRange(begin: number, end: number, size: number | undefined, name: string): void {
  const valid = Number.isSafeInteger(begin) && Number.isSafeInteger(end) && begin >= 0 && begin < end;
  if (valid && (size === undefined || end <= size)) return;
  throw new SourceError({
    code: "SOURCE_RANGE",
    file: name,
    cause: `bytes ${begin} to ${end} do not lie in the file${size === undefined ? "" : ` of ${size} bytes`}`,
    fix: "Check that the file is complete",
  });
}
