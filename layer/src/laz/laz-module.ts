/** What decides how records are compressed. */
export interface RecordLayout {
  /** Point format, 6 to 8. */
  readonly format: number;
  /** Bytes of a record beyond those of the format. */
  readonly extra: number;
}

/** What is asked of the compressor. */
export type LazTask = "describe" | "compress" | "table";

/** Records of which a chunk consists. */
export interface ChunkFormat {
  /** 0 to 10. */
  readonly pointFormat: number;
  /** Bytes. */
  readonly recordLength: number;
}

interface LazExports {
  readonly memory: WebAssembly.Memory;
  reserve(length: number): number;
  output(): number;
  output_length(): number;
  describe(format: number, extra: number): number;
  compress(format: number, extra: number): number;
  table(format: number, extra: number): number;
  open(format: number, length: number): number;
  decompress(count: number): number;
}

/** Records that are decoded at once, so that the module's memory, which never shrinks, holds a chunk and not its points. */
const BLOCK = 4096;

/** LASzip of the converter's core (`converter/wasm`) as a module of WebAssembly. It makes no code of text. */
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
    this.#give(input);
    if (this.#exports[task](format, extra) !== 0)
      throw new RangeError(
        `records of point format ${format} with ${extra} extra bytes cannot be compressed`,
      );
    return this.#output().slice();
  }

  /**
   * The first records of a chunk, uncompressed, `count · recordLength` bytes.
   *
   * @throws RangeError where there are no such records, or the chunk ends before them
   * @throws WebAssembly.RuntimeError where damaged data lead the decoder astray; the module is of no use after it
   */
  decode(chunk: Uint8Array, { pointFormat, recordLength }: ChunkFormat, count: number): Uint8Array {
    this.#give(chunk);
    if (this.#exports.open(pointFormat, recordLength) !== 0)
      throw new RangeError(`there are no records of point format ${pointFormat} with ${recordLength} bytes`);
    const records = new Uint8Array(count * recordLength);
    for (let first = 0; first < count; first += BLOCK) {
      if (this.#exports.decompress(Math.min(BLOCK, count - first)) !== 0)
        throw new RangeError("the compressed points end too early");
      records.set(this.#output(), first * recordLength);
    }
    return records;
  }

  #give(input: Uint8Array): void {
    const at = this.#exports.reserve(input.length);
    new Uint8Array(this.#exports.memory.buffer, at, input.length).set(input);
  }

  /** A view that is good until the module is called again: its memory may grow, and with it its buffer. */
  #output(): Uint8Array {
    const { memory, output, output_length } = this.#exports;
    return new Uint8Array(memory.buffer, output(), output_length());
  }
}
