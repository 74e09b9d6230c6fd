import type { ByteSource, ReadOptions } from "./byte-source.js";
import type { ServerWait } from "./host-schedule.js";

/** Bytes of a file, from one of its bytes on. */
interface Known {
  readonly begin: number;
  readonly bytes: Uint8Array;
}

/** A file of which a part may be read ahead, for what lies in it to cost no further request. */
export class KnownParts implements ByteSource {
  readonly #source: ByteSource;
  #known: Known | undefined;

  constructor(source: ByteSource) {
    this.#source = source;
  }

  get name(): string {
    return this.#source.name;
  }

  get size(): number | undefined {
    return this.#source.size;
  }

  get wait(): ServerWait | undefined {
    return this.#source.wait;
  }

  /** Reads a part ahead, in place of any before. @throws SourceError */
  async readAhead(begin: number, end: number, options: ReadOptions): Promise<void> {
    this.#known = { begin, bytes: await this.#source.read(begin, end, options) };
  }

  async read(begin: number, end: number, options?: ReadOptions): Promise<Uint8Array> {
    const known = this.#known;
    const at = known ? begin - known.begin : -1;
    const length = end - begin;
    if (known && at >= 0 && length > 0 && at + length <= known.bytes.length) {
      return known.bytes.slice(at, at + length);
    }
    return this.#source.read(begin, end, options);
  }

  /** Keeps nothing of what was read ahead. */
  forget(): void {
    this.#known = undefined;
  }
}
