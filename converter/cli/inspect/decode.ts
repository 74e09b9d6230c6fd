import type { Scan } from "../core/core.js";
import { dropLazPerf, lazPerf } from "../files/laz-perf.js";

/** Point formats that laz-perf decodes. */
const DECODABLE = new Set([0, 1, 2, 3, 6, 7, 8]);

/**
 * The first records of a LAZ chunk, uncompressed, `count · recordLength` bytes. The decoder has a memory of its own, in
 * which damaged data can do no harm; one that failed is not used again.
 *
 * @throws Error where laz-perf gives up, or does not know the point format
 */
export async function decodeChunk(
  chunk: Uint8Array,
  { pointFormat, recordLength }: Pick<Scan, "pointFormat" | "recordLength">,
  count: number,
): Promise<Uint8Array> {
  if (!DECODABLE.has(pointFormat)) throw new Error(`point format ${pointFormat} cannot be decoded`);
  const module = await lazPerf();
  try {
    const input = module._malloc(chunk.length);
    const output = module._malloc(recordLength);
    module.HEAPU8.set(chunk, input);
    const decoder = new module.ChunkDecoder();
    decoder.open(pointFormat, recordLength, input);
    const records = new Uint8Array(count * recordLength);
    for (let index = 0; index < count; index++) {
      decoder.getPoint(output);
      records.set(module.HEAPU8.subarray(output, output + recordLength), index * recordLength);
    }
    decoder.delete();
    module._free(output);
    module._free(input);
    return records;
  } catch (error) {
    dropLazPerf();
    throw error;
  }
}
