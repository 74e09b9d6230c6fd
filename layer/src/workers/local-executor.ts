import type { LazDecoder } from "./laz-decoder.js";
import { type PreparedDataSet, prepareDataSet, runNodeJob } from "./node-job.js";
import type { DataSetSpec, NodeExecutor, NodeJob, NodeVertices } from "./protocol.js";

/** Carries out node jobs on the calling thread: for tools and tests, where nothing else waits for it. */
export class LocalExecutor implements NodeExecutor {
  readonly #decoder: LazDecoder;
  readonly #dataSets = new Map<number, PreparedDataSet>();
  #next = 1;
  #pending = 0;

  constructor(decoder: LazDecoder) {
    this.#decoder = decoder;
  }

  get pending(): number {
    return this.#pending;
  }

  addDataSet(spec: DataSetSpec): number {
    this.#dataSets.set(this.#next, prepareDataSet(spec));
    return this.#next++;
  }

  removeDataSet(id: number): void {
    this.#dataSets.delete(id);
  }

  async run(job: NodeJob, signal?: AbortSignal): Promise<NodeVertices> {
    signal?.throwIfAborted();
    const dataSet = this.#dataSets.get(job.dataSet);
    if (!dataSet) throw new Error(`data set ${job.dataSet} was never added or is removed`);
    this.#pending++;
    try {
      return await runNodeJob(dataSet, job, this.#decoder);
    } finally {
      this.#pending--;
    }
  }

  destroy(): void {
    this.#dataSets.clear();
  }
}
