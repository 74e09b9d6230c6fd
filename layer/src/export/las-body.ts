import type { ByteSink } from "./byte-sink.js";

/** The points of a LAS file as they stand in it, and what the front of the file says of that. */
export interface LasBody {
  /** Header and records before the points, from those that plain points have; as long at the end as at first. */
  front(plain: Uint8Array): Uint8Array;
  /** Takes whole records; the bytes are given away. */
  take(records: Uint8Array<ArrayBuffer>): Promise<void>;
  /** Writes what was not written yet. */
  end(): Promise<void>;
}

/** Bytes that are gathered before they are written, and those that room is made for at first. */
const BLOCK = 1 << 20;
const FIRST = 1 << 10;

/** Records as they are, small pieces of them as large ones. */
export class PlainBody implements LasBody {
  readonly #sink: ByteSink;
  /** Grows to its size: small files of many sections have no use for all of it. */
  #block = new Uint8Array(0);
  #filled = 0;

  constructor(sink: ByteSink) {
    this.#sink = sink;
  }

  front(plain: Uint8Array): Uint8Array {
    return plain;
  }

  async take(bytes: Uint8Array): Promise<void> {
    if (this.#filled + bytes.length > BLOCK) await this.end();
    if (bytes.length > BLOCK) {
      await this.#sink.write(bytes);
      return;
    }
    if (this.#filled + bytes.length > this.#block.length) {
      const wanted = Math.max(FIRST, 2 * (this.#filled + bytes.length));
      const larger = new Uint8Array(Math.min(BLOCK, wanted));
      larger.set(this.#block.subarray(0, this.#filled));
      this.#block = larger;
    }
    this.#block.set(bytes, this.#filled);
    this.#filled += bytes.length;
  }

  async end(): Promise<void> {
    if (this.#filled > 0) await this.#sink.write(this.#block.subarray(0, this.#filled));
    this.#filled = 0;
  }
}
