import { checkChecksum } from "../sources/contract/checksum.js";
import type { Encoding } from "../sources/open-source.js";
import type { LazDecoder } from "./laz-decoder.js";
import type { DecodedPoints, Encoded, Expected, PointDecoder } from "./point-decoder.js";

/** A decoder for each encoding. */
export type Decoders = {
  readonly [Kind in Encoding["kind"]]: PointDecoder<Encoded<Kind>>;
};

/** All decoders, of which LAZ's needs WebAssembly that comes in different ways. A further one is a line here. */
export function decodersWith(laz: LazDecoder): Decoders {
  return { laz };
}

/**
 * Decodes a chunk by the decoder of its encoding, once it is the one that was written.
 * @throws DecodeError DECODE_CHECKSUM, DECODE_CHUNK
 */
export async function decode(
  decoders: Decoders,
  chunk: Uint8Array,
  encoding: Encoding,
  expected: Expected,
): Promise<DecodedPoints> {
  checkChecksum(chunk, expected.checksum, expected);
  const decoder: PointDecoder<Encoding> = decoders[encoding.kind];
  return decoder.decode(chunk, encoding, expected);
}
