import { DecodeError } from "../errors/index.js";
import type { Encoded, Expected } from "./point-decoder.js";

/** Layers of a compressed record of format 6 (LAZ 1.4): xy and returns, z, class, flags, intensity, angle, user data, source, time. */
const BASE_LAYERS = 9;
/** Further layers by format: colour in 7, colour and infrared in 8. */
const COLOUR_LAYERS: Readonly<Record<number, number>> = { 6: 0, 7: 1, 8: 2 };

/**
 * Holds a chunk's own table of contents against its length and the octree, because the decoder reads on
 * without looking where the chunk ends. A chunk of formats 6 to 8 is the first record as it is, the number of
 * points (uint32), the length of each layer (uint32, one layer per extra byte), then the layers
 * (LAZ specification 1.4, "layered chunk").
 * @throws DecodeError DECODE_CHUNK
 */
export function checkChunk(
  chunk: Uint8Array,
  { pointFormat, recordLength, extraLength }: Encoded<"laz">,
  { pointCount, file, node }: Expected,
): void {
  const layers = BASE_LAYERS + (COLOUR_LAYERS[pointFormat] ?? 0) + extraLength;
  const contents = recordLength + 4 + 4 * layers;
  if (chunk.length < contents) throw badChunk(file, node, `${chunk.length} bytes are too few`);
  const view = new DataView(chunk.buffer, chunk.byteOffset, chunk.byteLength);
  const count = view.getUint32(recordLength, true);
  if (count !== pointCount)
    throw badChunk(file, node, `it holds ${count} points, the octree says ${pointCount}`);
  let length = contents;
  for (let layer = 0; layer < layers; layer++) length += view.getUint32(recordLength + 4 + 4 * layer, true);
  if (length !== chunk.length) {
    throw badChunk(file, node, `it describes ${length} bytes, the octree says ${chunk.length}`);
  }
}

/** The error for compressed points that cannot be what the writer wrote. */
export function badChunk(file: string, node: string, cause: string): DecodeError {
  return new DecodeError({
    code: "DECODE_CHUNK",
    file,
    cause: `the points of node ${node} are damaged: ${cause}`,
    fix: "Copy or convert the file again",
  });
}
