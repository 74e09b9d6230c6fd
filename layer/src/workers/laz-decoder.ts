import { badChunk, checkChunk } from "./chunk-layout.js";
import type { DecodedPoints, Encoded, Expected, PointDecoder } from "./point-decoder.js";
import { readCoordinates } from "./records.js";

/** The part of laz-perf's module that is used; its own types lean on a package that is not there. */
export interface LazPerf {
  HEAPU8: Uint8Array;
  _malloc(length: number): number;
  _free(pointer: number): void;
  ChunkDecoder: new () => {
    open(pointFormat: number, recordLength: number, chunk: number): void;
    getPoint(record: number): void;
    delete(): void;
  };
}

/** Records decoded into WebAssembly memory before they are copied out at once. */
const BLOCK = 4096;

/** Decodes LAZ chunks of point formats 6, 7 and 8. */
export class LazDecoder implements PointDecoder<Encoded<"laz">> {
  readonly #create: () => Promise<LazPerf>;
  #module: Promise<LazPerf> | undefined;

  /** @param create makes a fresh laz-perf module; it comes in one form for workers and one for Node */
  constructor(create: () => Promise<LazPerf>) {
    this.#create = create;
  }

  /** The module, made ahead of the first chunk where this is called before. */
  prepare(): Promise<LazPerf> {
    this.#module ??= this.#create().catch((thrown: unknown) => {
      this.#module = undefined;
      throw thrown;
    });
    return this.#module;
  }

  /** @throws DecodeError DECODE_CHUNK */
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
    { pointFormat, recordLength }: Encoded<"laz">,
    { pointCount, file, node }: Expected,
  ): Promise<Uint8Array> {
    const module = await this.prepare();
    try {
      return decodeWith(module, chunk, pointFormat, recordLength, pointCount);
    } catch (thrown) {
      // After a trap the memory of the module is in no known state: the next chunk gets a fresh one.
      this.#module = undefined;
      throw badChunk(file, node, thrown instanceof Error ? thrown.message : "the decoder failed");
    }
  }
}

function decodeWith(
  module: LazPerf,
  chunk: Uint8Array,
  pointFormat: number,
  recordLength: number,
  pointCount: number,
): Uint8Array {
  const records = new Uint8Array(pointCount * recordLength);
  const chunkPointer = module._malloc(chunk.length);
  const blockPointer = module._malloc(BLOCK * recordLength);
  const decoder = new module.ChunkDecoder();
  try {
    module.HEAPU8.set(chunk, chunkPointer);
    decoder.open(pointFormat, recordLength, chunkPointer);
    for (let first = 0; first < pointCount; first += BLOCK) {
      const count = Math.min(BLOCK, pointCount - first);
      for (let index = 0; index < count; index++) decoder.getPoint(blockPointer + index * recordLength);
      // Read anew each time: the memory moves when it grows.
      const block = module.HEAPU8.subarray(blockPointer, blockPointer + count * recordLength);
      records.set(block, first * recordLength);
    }
  } finally {
    decoder.delete();
    module._free(blockPointer);
    module._free(chunkPointer);
  }
  return records;
}
