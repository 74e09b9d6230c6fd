import { LazModule } from "@groma/layer/query";
import type { Scan } from "../core/core.js";
import { lazBytes } from "../files/laz.js";

let module: Promise<LazModule> | undefined;

/**
 * The first records of a LAZ chunk, uncompressed, `count · recordLength` bytes. The decoder has a memory of its own, in
 * which damaged data can do no harm; one that failed is not used again.
 *
 * @throws Error where the chunk cannot be decoded
 */
export async function decodeChunk(
  chunk: Uint8Array,
  format: Pick<Scan, "pointFormat" | "recordLength">,
  count: number,
): Promise<Uint8Array> {
  module ??= lazBytes().then((bytes) => LazModule.load(bytes));
  try {
    return (await module).decode(chunk, format, count);
  } catch (error) {
    module = undefined;
    throw error;
  }
}
