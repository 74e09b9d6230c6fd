import { type ByteSink, GatheringSink } from "./byte-sink.js";

/** The points of a LAS file as they stand in it, and what the front of the file says of that. */
export interface LasBody {
  /** Header and records before the points, from those that plain points have; as long at the end as at first. */
  front(plain: Uint8Array): Uint8Array;
  /** Takes whole records; the bytes are given away. */
  take(records: Uint8Array<ArrayBuffer>): Promise<void>;
  /** Writes what was not written yet. */
  end(): Promise<void>;
}

/** Records as they are, small pieces of them as large ones. */
export class PlainBody implements LasBody {
  readonly #records: GatheringSink;

  constructor(sink: ByteSink) {
    this.#records = new GatheringSink(sink);
  }

  front(plain: Uint8Array): Uint8Array {
    return plain;
  }

  async take(bytes: Uint8Array): Promise<void> {
    await this.#records.write(bytes);
  }

  async end(): Promise<void> {
    await this.#records.end();
  }
}
