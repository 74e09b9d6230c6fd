import core from "../../../converter/target/wasm32-wasip1/release/groma-core.wasm?url";
import { checkAnnounced } from "./announced.js";
import type { CoreEvent } from "./core-run.js";
import type { IndexAnswer, IndexTask } from "./index.worker.js";
import { changed, IndexError } from "./index-error.js";

/** A scan that was indexed in the page. */
export interface Indexed {
  /** A COPC file of the scan's name. */
  readonly copc: File;
  /** What was not as the standard has it, and what was made of it, in the core's words. */
  readonly warnings: readonly string[];
}

/** How far indexing is. */
export type IndexProgress = Extract<CoreEvent, { event: "progress" }>;

/**
 * Makes a COPC file of a LAS or LAZ file: by the converter's core, in a worker, in memory. The file's bytes are read
 * when they are needed.
 *
 * @throws IndexError with the core's code (`INPUT_…`), INDEX_POINTS, INDEX_CORE, INDEX_FAILED, SOURCE_CHANGED; the
 *   signal's reason
 */
export async function indexFile(
  scan: File,
  { onProgress, signal }: { onProgress: (progress: IndexProgress) => void; signal: AbortSignal },
): Promise<Indexed> {
  await checkAnnounced(scan);
  signal.throwIfAborted();
  const worker = new Worker(new URL("./index.worker.ts", import.meta.url), {
    type: "module",
    name: "groma-index",
  });
  const warnings: string[] = [];
  try {
    return await new Promise<Indexed>((resolve, reject) => {
      signal.addEventListener("abort", () => reject(signal.reason), { once: true });
      worker.addEventListener("error", ({ message }) => reject(absent(message || "worker")));
      worker.addEventListener("message", ({ data }: MessageEvent<IndexAnswer>) => {
        if (data.event === "progress") onProgress(data);
        else if (data.event === "warning") warnings.push(data.text.replace(/^scan: /, ""));
        else if (data.event === "made") {
          const { name, lastModified } = scan;
          resolve({ copc: new File([data.copc], name, { lastModified }), warnings });
        } else reject(failure(data));
      });
      worker.postMessage({ scan, core: new URL(core, location.href).href } satisfies IndexTask);
    });
  } finally {
    worker.terminate();
  }

  function failure(end: Exclude<IndexAnswer, CoreEvent | { event: "made" }>): IndexError {
    if (end.event === "error") return new IndexError({ ...end, file: scan.name });
    if (end.event === "absent") return absent(end.reason);
    if (end.event === "unread") return changed(scan.name, end.reason);
    return new IndexError({
      code: "INDEX_FAILED",
      file: scan.name,
      cause: `it could not be indexed in the page (${end.complaint})`,
      fix: "Convert it: groma convert IN OUT.copc.laz",
    });
  }

  function absent(reason: string): IndexError {
    return new IndexError({
      code: "INDEX_CORE",
      file: scan.name,
      cause: `the core that would index it cannot be loaded (${reason})`,
      fix: "Serve the folder assets beside the page",
    });
  }
}
