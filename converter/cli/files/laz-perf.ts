import type { LazPerf } from "@groma/layer/query";
import { create } from "laz-perf/lib/node/index.js";

let module: Promise<LazPerf> | undefined;

/**
 * The decoder of LAZ, one for all files: each module puts two listeners on the process and leaves them there. After a
 * failure its memory is in no known state; the command then ends.
 */
export function lazPerf(): Promise<LazPerf> {
  module ??= create() as unknown as Promise<LazPerf>;
  return module;
}
