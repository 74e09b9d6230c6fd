import { FormatError, toWire } from "../../errors/index.js";
import { fetchModule, LazModule } from "../../laz/index.js";
import type { LazReply, LazRequest } from "./laz-worker.js";

/** The worker's side of compression. Bundled into one file, `laz.worker.js`, by `scripts/copy-assets.mjs`. */
declare const self: DedicatedWorkerGlobalScope;

let module: Promise<LazModule> | undefined;

async function load(): Promise<LazModule> {
  // The worker that decodes nodes has it already.
  const file = new URL("../../workers/groma-laz.wasm", import.meta.url).href;
  try {
    return await LazModule.load(await fetchModule(file));
  } catch (thrown) {
    throw new FormatError({
      ...{ code: "EXPORT_NO_LAZ", file, cause: (thrown as Error).message },
      fix: "Serve groma-laz.wasm, or write LAS; groma profile and groma clip write LAZ too",
    });
  }
}

async function answer({ id, task, layout, input }: LazRequest): Promise<void> {
  try {
    module ??= load();
    const bytes = (await module).run(task, layout, input);
    const reply: LazReply = { id, bytes };
    self.postMessage(reply, [bytes.buffer]);
  } catch (thrown) {
    const fallback = { code: "EXPORT_NO_LAZ", file: "LAZ", fix: "Write LAS" };
    const reply: LazReply = { id, fault: toWire(thrown, fallback) };
    self.postMessage(reply);
  }
}

self.onmessage = ({ data }: MessageEvent<LazRequest>) => void answer(data);
