import { LazDecoder, type LazPerf, LocalExecutor } from "@groma/layer";
import { create } from "laz-perf/lib/node/index.js";

/** One decoder for all: each module of laz-perf puts two listeners on the process and leaves them there. */
const decoder = new LazDecoder(() => create() as unknown as Promise<LazPerf>);

/** Decodes on this thread: Node has no workers of the kind that a page has. */
export function localExecutor(): LocalExecutor {
  return new LocalExecutor(decoder);
}
