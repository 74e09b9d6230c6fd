import type { LazPerf } from "@groma/layer/query";
import { create } from "laz-perf/lib/node/index.js";

let module: Promise<LazPerf> | undefined;

/**
 * The decoder of LAZ, one for all chunks of all files: each module takes megabytes, and puts two listeners on the process,
 * that go only with the process.
 */
export function lazPerf(): Promise<LazPerf> {
  module ??= create() as unknown as Promise<LazPerf>;
  return module;
}

/** After a failure the decoder's memory is in no known state: the next chunk gets a fresh one. */
export function dropLazPerf(): void {
  module = undefined;
}
