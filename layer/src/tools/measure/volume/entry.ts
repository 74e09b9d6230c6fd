import { toWire } from "../../../errors/index.js";
import type { VolumeReply } from "./in-worker.js";
import { runVolumeJob, type VolumeJob } from "./volume-job.js";

/** The worker's side of a volume. Bundled into one file, `volume.worker.js`, by `scripts/copy-assets.mjs`. */
declare const self: DedicatedWorkerGlobalScope;

const answer = (reply: VolumeReply) => self.postMessage(reply);

self.onmessage = ({ data }: MessageEvent<VolumeJob>) => {
  try {
    const sums = runVolumeJob(data, (share) => answer({ kind: "progress", share }));
    answer({ kind: "done", sums });
  } catch (thrown) {
    const fallback = {
      code: "MEASURE_WORKER",
      file: "volume",
      fix: "Draw a smaller polygon, or take fewer classes",
    };
    answer({ kind: "failed", fault: toWire(thrown, fallback) });
  }
};
