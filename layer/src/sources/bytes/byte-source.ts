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
  /**
   * Bytes `begin` (inclusive) to `end` (exclusive), exactly `end − begin` of them.
   * @throws SourceError when they cannot be had.
   */
  read(begin: number, end: number, options?: ReadOptions): Promise<Uint8Array>;
}

/** True for what looks like a {@link ByteSource} rather than an address or a Blob. */
export function isByteSource(value: unknown): value is ByteSource {
  return typeof value === "object" && value !== null && "read" in value && typeof value.read === "function";
}
