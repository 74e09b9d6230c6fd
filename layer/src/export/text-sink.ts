import type { ByteSink } from "./byte-sink.js";

/** Characters that are gathered before they are written. */
const BLOCK = 1 << 18;

/** Writes text, UTF-8, in blocks. */
export class TextSink {
  readonly #sink: ByteSink;
  readonly #encoder = new TextEncoder();
  #text = "";

  constructor(sink: ByteSink) {
    this.#sink = sink;
  }

  add(text: string): void {
    this.#text += text;
  }

  /** Writes what was gathered, once it is a block. */
  async rest(): Promise<void> {
    if (this.#text.length >= BLOCK) await this.end();
  }

  /** Writes what was gathered. */
  async end(): Promise<void> {
    const text = this.#text;
    this.#text = "";
    if (text !== "") await this.#sink.write(this.#encoder.encode(text));
  }
}
