import type { FaultWire } from "@groma/georef";
import { fromWire, MeasureError } from "../../../errors/index.js";
import type { Progress } from "./base.js";
import type { VolumeJob, VolumeSums } from "./volume-job.js";

/** From the worker to the page. */
export type VolumeReply =
  | { readonly kind: "progress"; readonly share: number }
  | { readonly kind: "done"; readonly sums: VolumeSums }
  | { readonly kind: "failed"; readonly fault: FaultWire };

/** The part of `Worker` that a volume needs. */
export interface VolumeWorker {
  postMessage(job: VolumeJob, transfer: Transferable[]): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<VolumeReply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

interface WorkerOptions {
  readonly signal?: AbortSignal | undefined;
  readonly onProgress: Progress;
  readonly createWorker?: (() => VolumeWorker) | undefined;
}

/**
 * Works a volume out in a worker of its own, which ends with it or with the signal. The points are given away.
 * @throws MeasureError MEASURE_WORKER where there is no worker to be had; those of `runVolumeJob`; the signal's reason
 */
export async function inWorker(job: VolumeJob, options: WorkerOptions): Promise<VolumeSums> {
  const { signal, onProgress, createWorker = createDefaultWorker } = options;
  signal?.throwIfAborted();
  const worker = createWorker();
  const stop = new AbortController();
  try {
    return await new Promise<VolumeSums>((resolve, reject) => {
      signal?.addEventListener("abort", () => reject(signal.reason), { signal: stop.signal });
      worker.onerror = (event) => {
        event.preventDefault();
        reject(lost(event.message || "its script cannot be loaded"));
      };
      worker.onmessage = ({ data }) => {
        if (data.kind === "progress") onProgress(data.share);
        else if (data.kind === "done") resolve(data.sums);
        else reject(fromWire(data.fault));
      };
      const base = "points" in job.base ? job.base.points : [];
      worker.postMessage(
        job,
        [...job.points, ...base].map(({ buffer }) => buffer as ArrayBuffer),
      );
    });
  } finally {
    stop.abort();
    worker.terminate();
  }
}

function createDefaultWorker(): VolumeWorker {
  return new Worker(new URL("./volume.worker.js", import.meta.url), { type: "module", name: "groma-volume" });
}

function lost(cause: string): MeasureError {
  return new MeasureError({
    code: "MEASURE_WORKER",
    file: "volume",
    cause: `the worker that makes the surfaces died: ${cause}`,
    fix: "Check that volume.worker.js is served and that the page allows workers; draw a smaller polygon",
  });
}
