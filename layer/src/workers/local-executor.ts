import { type Decoders, decodersWith } from "./decoders.js";
import type { LazDecoder } from "./laz-decoder.js";
import { type PreparedDataSet, preparedOnce, runNodeJob, runRecordsJob } from "./node-job.js";
import type { ChunkJob, DataSetSpec, NodeExecutor, NodeJob, NodeRecords, NodeVertices } from "./protocol.js";

/** Carries out node jobs on the calling thread: for tools and tests, where nothing else waits for it. */
export class LocalExecutor implements NodeExecutor {
  readonly #decoders: Decoders;
  readonly #dataSets = new Map<number, () => Promise<PreparedDataSet>>();
  #next = 1;
  #pending = 0;

  constructor(laz: LazDecoder) {
    this.#decoders = decodersWith(laz);
  }

  get pending(): number {
    return this.#pending;
  }

  addDataSet(spec: DataSetSpec): number {
    this.#dataSets.set(
      this.#next,
      preparedOnce(spec, () => import("./projections.js")),
    );
    return this.#next++;
  }

  removeDataSet(id: number): void {
    this.#dataSets.delete(id);
  }

  run(job: NodeJob, signal?: AbortSignal): Promise<NodeVertices> {
    return this.#carryOut(job, signal, (dataSet) => runNodeJob(dataSet, job, this.#decoders));
  }

  records(job: ChunkJob, signal?: AbortSignal): Promise<NodeRecords> {
    return this.#carryOut(job, signal, (dataSet) => runRecordsJob(dataSet, job, this.#decoders));
  }

  destroy(): void {
    this.#dataSets.clear();
  }

  async #carryOut<T>(
    job: ChunkJob,
    signal: AbortSignal | undefined,
    work: (dataSet: PreparedDataSet) => Promise<T>,
  ): Promise<T> {
    signal?.throwIfAborted();
    const dataSet = this.#dataSets.get(job.dataSet);
    if (!dataSet) throw new Error(`data set ${job.dataSet} was never added or is removed`);
    this.#pending++;
    try {
      return await work(await dataSet());
    } finally {
      this.#pending--;
    }
  }
}
