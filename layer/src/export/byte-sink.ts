/** Where a file is written to, one part after the other: a file on disk, a stream of the page's, memory. */
export interface ByteSink {
  /** Appends; the bytes are the caller's again once the promise is fulfilled. */
  write(bytes: Uint8Array): Promise<void>;
  /** Puts bytes over those that begin at a place and were written before. */
  overwrite(at: number, bytes: Uint8Array): Promise<void>;
}

/** A sink in memory, for tests and for small files. */
export class MemorySink implements ByteSink {
  readonly #parts: Uint8Array[] = [];

  async write(bytes: Uint8Array): Promise<void> {
    this.#parts.push(bytes.slice());
  }

  async overwrite(at: number, bytes: Uint8Array): Promise<void> {
    let begin = 0;
    for (const part of this.#parts) {
      const from = Math.max(0, begin - at);
      const to = Math.min(bytes.length, begin + part.length - at);
      if (from < to) part.set(bytes.subarray(from, to), at + from - begin);
      begin += part.length;
    }
  }

  /** All that was written, in one piece. */
  bytes(): Uint8Array<ArrayBuffer> {
    const bytes = new Uint8Array(this.#parts.reduce((sum, { length }) => sum + length, 0));
    let at = 0;
    for (const part of this.#parts) {
      bytes.set(part, at);
      at += part.length;
    }
    return bytes;
  }

  /** All that was written; its parts are copied by the Blob. */
  blob(type = "application/octet-stream"): Blob {
    return new Blob(this.#parts as Uint8Array<ArrayBuffer>[], { type });
  }
}
