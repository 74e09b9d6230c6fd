import { LazModule } from "../laz/index.js";
import { badChunk, checkChunk } from "./chunk-layout.js";
import type { DecodedPoints, Encoded, Expected, PointDecoder } from "./point-decoder.js";
import { readCoordinates } from "./records.js";

/** Decodes LAZ chunks of point formats 6, 7 and 8. */
export class LazDecoder implements PointDecoder<Encoded<"laz">> {
  readonly #load: () => Promise<BufferSource>;
  #module: Promise<LazModule> | undefined;

  /** @param load gives the bytes of `groma-laz.wasm`: a page fetches them, Node reads `@groma/layer/laz.wasm` */
  constructor(load: () => Promise<BufferSource>) {
    this.#load = load;
  }

  /** Makes the decoder ahead of the first chunk. @throws whatever `load` throws */
  async prepare(): Promise<void> {
    await this.#ready();
  }

  #ready(): Promise<LazModule> {
    this.#module ??= this.#load()
      .then((bytes) => LazModule.load(bytes))
      .catch((thrown: unknown) => {
        this.#module = undefined;
        throw thrown;
      });
    return this.#module;
  }

  /** @throws DecodeError DECODE_CHUNK; whatever `load` throws */
  async decode(chunk: Uint8Array, encoding: Encoded<"laz">, expected: Expected): Promise<DecodedPoints> {
    checkChunk(chunk, encoding, expected);
    const bytes = await this.#records(chunk, encoding, expected);
    const { recordLength, fields } = encoding;
    return {
      xyz: readCoordinates(bytes, recordLength),
      attributes: fields.map((field) => ({ ...field, bytes, stride: recordLength })),
      lasRecords: bytes,
    };
  }

  /** Uncompressed records, `pointCount · recordLength` bytes. */
  async #records(
    chunk: Uint8Array,
    encoding: Encoded<"laz">,
    { pointCount, file, node }: Expected,
  ): Promise<Uint8Array> {
    const module = await this.#ready();
    try {
      return module.decode(chunk, encoding, pointCount);
    } catch (thrown) {
      // After a trap the memory of the module is in no known state: the next chunk gets a fresh one.
      this.#module = undefined;
      throw badChunk(file, node, thrown instanceof Error ? thrown.message : "the decoder failed");
    }
  }
}
