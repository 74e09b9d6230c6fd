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

/** Bytes that room is made for at first. */
const FIRST = 1 << 10;

/** Bytes in one block, which grows and is used again: for many small files, one after the other. */
export class BlockSink implements ByteSink {
  #block = new Uint8Array(0);
  #filled = 0;

  /** Bytes that were written since it was cleared. */
  get length(): number {
    return this.#filled;
  }

  append(bytes: Uint8Array): void {
    const length = this.#filled + bytes.length;
    if (length > this.#block.length) {
      const larger = new Uint8Array(Math.max(FIRST, 2 * length));
      larger.set(this.bytes());
      this.#block = larger;
    }
    this.#block.set(bytes, this.#filled);
    this.#filled = length;
  }

  async write(bytes: Uint8Array): Promise<void> {
    this.append(bytes);
  }

  async overwrite(at: number, bytes: Uint8Array): Promise<void> {
    this.#block.set(bytes, at);
  }

  /** All that was written, where it stands: the caller's until more is. */
  bytes(): Uint8Array<ArrayBuffer> {
    return this.#block.subarray(0, this.#filled);
  }

  clear(): void {
    this.#filled = 0;
  }
}

/** Bytes that are gathered before they are written. */
export const GATHERED = 1 << 20;

/** Gathers small pieces, and hands large ones on as they are. */
export class GatheringSink {
  readonly #sink: Pick<ByteSink, "write">;
  readonly #block = new BlockSink();

  constructor(sink: Pick<ByteSink, "write">) {
    this.#sink = sink;
  }

  /** Appends; the bytes are the caller's again once the promise is fulfilled. */
  async write(bytes: Uint8Array): Promise<void> {
    if (this.#block.length + bytes.length > GATHERED) await this.end();
    if (bytes.length > GATHERED) await this.#sink.write(bytes);
    else this.#block.append(bytes);
  }

  /** Hands on what was gathered. */
  async end(): Promise<void> {
    if (this.#block.length > 0) await this.#sink.write(this.#block.bytes());
    this.#block.clear();
  }
}
