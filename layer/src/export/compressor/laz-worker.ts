import type { FaultWire } from "@groma/georef";
import { FormatError, fromWire } from "../../errors/index.js";
import type { LazTask, RecordLayout } from "../../laz/index.js";

/** From the page to the worker. */
export interface LazRequest {
  readonly id: number;
  readonly task: LazTask;
  readonly layout: RecordLayout;
  readonly input: Uint8Array<ArrayBuffer>;
}

/** From the worker to the page. */
export type LazReply =
  | { readonly id: number; readonly bytes: Uint8Array<ArrayBuffer> }
  | { readonly id: number; readonly fault: FaultWire };

/** Compresses records for LAZ; what it is given is given away. */
export interface PointCompressor {
  run(task: LazTask, layout: RecordLayout, input: Uint8Array<ArrayBuffer>): Promise<Uint8Array>;
  /** Ends it; what is still asked of it is never answered. */
  close(): void;
}

/** The part of `Worker` that compression needs. */
export interface LazWorkerLike {
  postMessage(request: LazRequest, transfer: Transferable[]): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<LazReply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

interface Waiting {
  readonly resolve: (bytes: Uint8Array) => void;
  readonly reject: (thrown: unknown) => void;
}

/** Compresses in a worker of its own, so that the page stays alive. */
export class LazWorker implements PointCompressor {
  readonly #worker: LazWorkerLike;
  readonly #waiting = new Map<number, Waiting>();
  #next = 0;

  constructor(worker: LazWorkerLike = defaultWorker()) {
    this.#worker = worker;
    worker.onmessage = ({ data }) => {
      const waiting = this.#waiting.get(data.id);
      this.#waiting.delete(data.id);
      if ("bytes" in data) waiting?.resolve(data.bytes);
      else waiting?.reject(fromWire(data.fault));
    };
    worker.onerror = (event) => {
      event.preventDefault();
      const thrown = lost(event.message || "its script cannot be loaded");
      for (const { reject } of this.#waiting.values()) reject(thrown);
      this.#waiting.clear();
    };
  }

  /** @throws FormatError EXPORT_NO_LAZ where the worker or its compressor cannot be had */
  run(task: LazTask, layout: RecordLayout, input: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
    const id = this.#next++;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject });
      this.#worker.postMessage({ id, task, layout, input }, [input.buffer]);
    });
  }

  close(): void {
    this.#worker.terminate();
    this.#waiting.clear();
  }
}

function defaultWorker(): LazWorkerLike {
  return new Worker(new URL("./laz.worker.js", import.meta.url), { type: "module", name: "groma-laz" });
}

function lost(cause: string): FormatError {
  return new FormatError({
    ...{ code: "EXPORT_NO_LAZ", file: "laz.worker.js", cause: `the worker that compresses died: ${cause}` },
    fix: "Check that laz.worker.js is served and that the page allows workers, or write LAS",
  });
}
