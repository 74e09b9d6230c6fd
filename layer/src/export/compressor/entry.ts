import { FormatError, toWire } from "../../errors/index.js";
import { LazModule } from "./laz-module.js";
import type { LazReply, LazRequest } from "./laz-worker.js";

/** The worker's side of compression. Bundled into one file, `laz.worker.js`, by `scripts/copy-assets.mjs`. */
declare const self: DedicatedWorkerGlobalScope;

let module: Promise<LazModule> | undefined;

async function load(): Promise<LazModule> {
  const file = new URL("./groma-laz.wasm", import.meta.url).href;
  const fail = (cause: string) =>
    new FormatError({
      ...{ code: "EXPORT_NO_LAZ", file, cause },
      fix: "Serve groma-laz.wasm beside laz.worker.js, or write LAS; groma profile and groma clip write LAZ too",
    });
  const response = await fetch(file).catch(() => undefined);
  if (!response?.ok) throw fail("the compressor cannot be fetched");
  const bytes = await response.arrayBuffer();
  return LazModule.load(bytes).catch((thrown: unknown) => {
    throw fail(`the compressor is no WebAssembly that runs here (${thrown})`);
  });
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
