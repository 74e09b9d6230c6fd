/** What decides how records are compressed. */
export interface RecordLayout {
  /** Point format, 6 to 8. */
  readonly format: number;
  /** Bytes of a record beyond those of the format. */
  readonly extra: number;
}

/** What is asked of the compressor. */
export type LazTask = "describe" | "compress" | "table";

interface LazExports {
  readonly memory: WebAssembly.Memory;
  reserve(length: number): number;
  output(): number;
  output_length(): number;
  describe(format: number, extra: number): number;
  compress(format: number, extra: number): number;
  table(format: number, extra: number): number;
}

/** The LAZ writer of the converter's core (`converter/wasm`) as a module of WebAssembly. */
export class LazModule {
  readonly #exports: LazExports;

  private constructor(exports: LazExports) {
    this.#exports = exports;
  }

  /** @param bytes of `groma-laz.wasm` @throws WebAssembly.CompileError, WebAssembly.LinkError */
  static async load(bytes: BufferSource): Promise<LazModule> {
    const { instance } = await WebAssembly.instantiate(bytes);
    return new LazModule(instance.exports as unknown as LazExports);
  }

  /**
   * - `describe`: the content of the record of LASzip; of no input
   * - `compress`: a chunk of whole records
   * - `table`: the chunk table, of the lengths of all chunks, u32, little endian
   * @throws RangeError where the layout is none, or the input makes no sense
   */
  run(task: LazTask, { format, extra }: RecordLayout, input: Uint8Array): Uint8Array<ArrayBuffer> {
    const { memory, reserve, output, output_length } = this.#exports;
    const at = reserve(input.length);
    new Uint8Array(memory.buffer, at, input.length).set(input);
    if (this.#exports[task](format, extra) !== 0)
      throw new RangeError(
        `records of point format ${format} with ${extra} extra bytes cannot be compressed`,
      );
    // Memory may have grown, and with it its buffer.
    return new Uint8Array(memory.buffer, output(), output_length()).slice();
  }
}
