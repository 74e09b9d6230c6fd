import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { LazDecoder, LocalExecutor } from "@groma/layer";
import { projectRoot } from "../project.js";

const decoder = new LazDecoder(() => readFile(join(projectRoot, "layer/dist/workers/groma-laz.wasm")));

/** Decodes on this thread: Node has no workers of the kind that a page has. */
export function localExecutor(): LocalExecutor {
  return new LocalExecutor(decoder);
}
