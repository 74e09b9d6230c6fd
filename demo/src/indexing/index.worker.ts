import type { Fault } from "@groma/georef";
import type { Bytes } from "./bytes-file.js";
import { type CoreEvent, CoreProgram } from "./core-run.js";

/** What the worker is asked once. */
export interface IndexTask {
  readonly scan: Blob;
  /** Address of `groma-core.wasm`. */
  readonly core: string;
}

/** What it answers: events, then one of the others. */
export type IndexAnswer =
  | CoreEvent
  | { readonly event: "made"; readonly copc: Blob }
  | ({ readonly event: "error" } & Fault)
  | { readonly event: "broken"; readonly complaint: string }
  /** The core cannot be loaded. */
  | { readonly event: "absent"; readonly reason: string };

/** Of workers alone, which the types of pages lack. */
declare const FileReaderSync: new () => { readAsArrayBuffer(blob: Blob): ArrayBuffer };

const answer = (message: IndexAnswer) => self.postMessage(message);

self.addEventListener("message", ({ data }: MessageEvent<IndexTask>) => void work(data));

async function work({ scan, core }: IndexTask): Promise<void> {
  let program: CoreProgram;
  try {
    program = new CoreProgram(await load(core));
  } catch (thrown) {
    return answer({ event: "absent", reason: thrown instanceof Error ? thrown.message : String(thrown) });
  }
  const outcome = await program.convert(bytesOf(scan), answer);
  if ("copc" in outcome) answer({ event: "made", copc: outcome.copc.toBlob() });
  else if ("fault" in outcome) answer({ event: "error", ...outcome.fault });
  else answer({ event: "broken", complaint: outcome.complaint });
}

async function load(core: string): Promise<WebAssembly.Module> {
  const response = await fetch(core);
  if (!response.ok) throw new Error(`the server answered HTTP ${response.status}`);
  // Whatever type the server says that it is.
  return WebAssembly.compile(await response.arrayBuffer());
}

/** A file as it lies on disk: the parts that are asked for are read when they are. */
function bytesOf(scan: Blob): Bytes {
  const reader = new FileReaderSync();
  const read = (begin: number, end: number) =>
    new Uint8Array(reader.readAsArrayBuffer(scan.slice(begin, end)));
  return { size: scan.size, read };
}
