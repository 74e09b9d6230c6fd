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
  /** The scan can no longer be read; the browser's name for that. */
  | { readonly event: "unread"; readonly reason: string }
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
  let unread: string | undefined;
  const outcome = await program.convert(
    bytesOf(scan, (reason) => {
      unread = reason;
    }),
    answer,
  );
  if (unread !== undefined) answer({ event: "unread", reason: unread });
  else if ("copc" in outcome) answer({ event: "made", copc: outcome.copc.toBlob() });
  else if ("fault" in outcome) answer({ event: "error", ...outcome.fault });
  else answer({ event: "broken", complaint: outcome.complaint });
}

async function load(core: string): Promise<WebAssembly.Module> {
  const response = await fetch(core);
  if (!response.ok) throw new Error(`the server answered HTTP ${response.status}`);
  // Whatever type the server says that it is.
  return WebAssembly.compile(await response.arrayBuffer());
}

/**
 * A file as it lies on disk: the parts that are asked for are read when they are.
 * @param failed hears the browser's name for why one cannot be
 */
function bytesOf(scan: Blob, failed: (reason: string) => void): Bytes {
  const reader = new FileReaderSync();
  const read = (begin: number, end: number) => {
    try {
      return new Uint8Array(reader.readAsArrayBuffer(scan.slice(begin, end)));
    } catch (thrown) {
      failed(thrown instanceof Error ? thrown.name : "unknown");
      throw thrown;
    }
  };
  return { size: scan.size, read };
}
