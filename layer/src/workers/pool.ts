import { DecodeError, fromWire } from "../errors/index.js";
import type {
  ChunkJob,
  DataSetSpec,
  NodeExecutor,
  NodeJob,
  NodeRecords,
  NodeVertices,
  WorkerReply,
  WorkerRequest,
} from "./protocol.js";

/** The part of `Worker` that the pool needs, so that a test can bring its own. */
export interface WorkerLike {
  postMessage(message: WorkerRequest, transfer: Transferable[]): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<WorkerReply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  onmessageerror: ((event: MessageEvent) => void) | null;
}

/** Options of a {@link WorkerPool}. */
export interface PoolOptions {
  /** Workers at most. Default: one less than the machine has threads, from 1 to 4. */
  readonly size?: number | undefined;
  /** Makes a worker, where the application's bundler or policy needs its own way. */
  readonly createWorker?: (() => WorkerLike) | undefined;
  /** Milliseconds after which a job's worker is taken for dead. Default: 60,000. */
  readonly jobTimeout?: number | undefined;
}

interface Task {
  readonly request: Extract<WorkerRequest, { readonly job: ChunkJob }>;
  readonly signal: AbortSignal | undefined;
  readonly resolve: (reply: WorkerReply) => void;
  readonly reject: (reason: unknown) => void;
  /** Workers that died over this job. */
  deaths: number;
}

interface Slot {
  readonly worker: WorkerLike;
  readonly known: Set<number>;
  task: Task | undefined;
  timer: ReturnType<typeof setTimeout> | undefined;
}

/** A job whose worker died is given to one more; two deaths are taken for the job's own fault. */
const MAX_DEATHS = 2;

/** Points that all workers together have in hand at most, each of which takes them some hundred bytes. */
const POINTS_AT_ONCE = 2 ** 21;

/** @throws DecodeError DECODE_WORKER where there are none, as in Node */
function createDefaultWorker(): WorkerLike {
  if (typeof Worker === "undefined") {
    throw new DecodeError({
      code: "DECODE_WORKER",
      file: "points",
      cause: "there are no web workers here to decode them, as in Node",
      fix: "Give the option executor: new LocalExecutor(new LazDecoder(load)), where load reads the file @groma/layer/laz.wasm",
    });
  }
  return new Worker(new URL("./node.worker.js", import.meta.url), { type: "module", name: "groma-node" });
}

function defaultSize(): number {
  const threads = typeof navigator === "undefined" ? 2 : (navigator.hardwareConcurrency ?? 2);
  return Math.max(1, Math.min(4, threads - 1));
}

/**
 * Workers that decode, place and pack nodes. Each has one job at a time, so a job that is no longer wanted
 * is dropped while it waits and costs nothing. Workers are made when first needed; one that dies is replaced.
 */
export class WorkerPool implements NodeExecutor {
  readonly #options: PoolOptions;
  readonly #size: number;
  readonly #slots: Slot[] = [];
  readonly #waiting: Task[] = [];
  readonly #dataSets = new Map<number, DataSetSpec>();
  #nextId = 1;
  #destroyed = false;

  constructor(options: PoolOptions = {}) {
    this.#options = options;
    this.#size = options.size ?? defaultSize();
  }

  /** Makes the first worker ahead of the first job, so that its scripts come while a file is opened. */
  warm(): void {
    try {
      if (this.#slots.length === 0) this.#grow();
    } catch {
      // Where there are no workers, the first job says so.
    }
  }

  get pending(): number {
    return this.#waiting.length + this.#slots.filter((slot) => slot.task).length;
  }

  addDataSet(spec: DataSetSpec): number {
    const id = this.#nextId++;
    this.#dataSets.set(id, spec);
    return id;
  }

  removeDataSet(id: number): void {
    this.#dataSets.delete(id);
    for (const slot of this.#slots) {
      if (slot.known.delete(id)) slot.worker.postMessage({ kind: "forget", id }, []);
    }
  }

  async run(job: NodeJob, signal?: AbortSignal): Promise<NodeVertices> {
    const reply = await this.#ask({ kind: "node", id: this.#nextId++, job }, signal);
    if (reply.kind !== "vertices") throw mixedUp(job.node);
    return reply.result;
  }

  async records(job: ChunkJob, signal?: AbortSignal): Promise<NodeRecords> {
    const reply = await this.#ask({ kind: "records", id: this.#nextId++, job }, signal);
    if (reply.kind !== "records") throw mixedUp(job.node);
    return reply.result;
  }

  /** Ends all workers. Jobs still open are rejected. */
  destroy(): void {
    this.#destroyed = true;
    const closed = destroyed();
    for (const task of this.#waiting.splice(0)) task.reject(closed);
    for (const slot of this.#slots.splice(0)) {
      clearTimeout(slot.timer);
      slot.worker.terminate();
      slot.task?.reject(closed);
    }
    this.#dataSets.clear();
  }

  #ask(request: Task["request"], signal: AbortSignal | undefined): Promise<WorkerReply> {
    return new Promise((resolve, reject) => {
      if (this.#destroyed) throw destroyed();
      signal?.throwIfAborted();
      const abandon = () => this.#abandon(task);
      const settle =
        <T>(then: (value: T) => void) =>
        (value: T) => {
          signal?.removeEventListener("abort", abandon);
          then(value);
        };
      const task: Task = { request, signal, resolve: settle(resolve), reject: settle(reject), deaths: 0 };
      signal?.addEventListener("abort", abandon, { once: true });
      this.#waiting.push(task);
      try {
        this.#dispatch();
      } catch (thrown) {
        // No worker can be made: nobody would ever take it.
        abandon();
        throw thrown;
      }
    });
  }

  /** A running job is let end, since a worker cannot be stopped halfway without losing it; nobody hears of it. */
  #abandon(task: Task): void {
    const index = this.#waiting.indexOf(task);
    if (index >= 0) this.#waiting.splice(index, 1);
    task.reject(task.signal?.reason);
    // The others may have waited for this one.
    if (index === 0) this.#dispatch();
  }

  #dispatch(): void {
    while (this.#waiting.length > 0) {
      if (!this.#hasRoomFor(this.#waiting[0])) return;
      const slot = this.#slots.find((candidate) => !candidate.task) ?? this.#grow();
      if (!slot) return;
      const task = this.#waiting.shift();
      if (task) this.#give(slot, task);
    }
  }

  /** Whether a job keeps within the points that are worked on at once. One goes alone, however many it has. */
  #hasRoomFor({ request }: Task): boolean {
    const busy = this.#slots.flatMap(({ task }) => task?.request.job.pointCount ?? []);
    const points = busy.reduce((sum, count) => sum + count, request.job.pointCount);
    return busy.length === 0 || points <= POINTS_AT_ONCE;
  }

  #grow(): Slot | undefined {
    if (this.#slots.length >= this.#size) return undefined;
    const worker = (this.#options.createWorker ?? createDefaultWorker)();
    const slot: Slot = { worker, known: new Set(), task: undefined, timer: undefined };
    worker.onmessage = ({ data }) => this.#receive(slot, data);
    worker.onerror = (event) => {
      event.preventDefault();
      this.#bury(slot, event.message || "its script cannot be loaded");
    };
    worker.onmessageerror = () => this.#bury(slot, "its answer cannot be read");
    this.#slots.push(slot);
    return slot;
  }

  #give(slot: Slot, task: Task): void {
    const { dataSet } = task.request.job;
    const spec = this.#dataSets.get(dataSet);
    if (!spec) {
      task.reject(new Error(`data set ${dataSet} was never added or is removed`));
      return;
    }
    slot.task = task;
    if (!slot.known.has(dataSet)) {
      slot.worker.postMessage({ kind: "dataSet", id: dataSet, spec }, []);
      slot.known.add(dataSet);
    }
    // The chunk is copied into the message rather than transferred: a second worker may need it.
    slot.worker.postMessage(task.request, []);
    const limit = this.#options.jobTimeout ?? 60_000;
    slot.timer = setTimeout(() => this.#bury(slot, `no answer within ${limit} ms`), limit);
  }

  #receive(slot: Slot, reply: WorkerReply): void {
    const { task } = slot;
    if (!task || task.request.id !== reply.id) return;
    clearTimeout(slot.timer);
    slot.task = undefined;
    if (reply.kind === "failed") task.reject(fromWire(reply.fault));
    else task.resolve(reply);
    this.#dispatch();
  }

  /** Takes a dead worker out and gives its job to another one, or up. */
  #bury(slot: Slot, cause: string): void {
    const index = this.#slots.indexOf(slot);
    if (index < 0) return;
    this.#slots.splice(index, 1);
    clearTimeout(slot.timer);
    slot.worker.terminate();
    const { task } = slot;
    if (task && !task.signal?.aborted) {
      task.deaths++;
      if (task.deaths < MAX_DEATHS) this.#waiting.unshift(task);
      else task.reject(workerError(task.request.job.node, cause));
    }
    this.#dispatch();
  }
}

/** A worker answered with something else than it was asked for: a bug of the layer's own. */
function mixedUp(node: string): Error {
  return new Error(`node ${node} was answered with something else`);
}

function workerError(node: string, cause: string): DecodeError {
  return new DecodeError({
    code: "DECODE_WORKER",
    file: `node ${node}`,
    cause: `the worker that decodes points died: ${cause}`,
    fix: "Check that node.worker.js is served and that the page allows workers",
  });
}

function destroyed(): DOMException {
  return new DOMException("the worker pool is destroyed", "AbortError");
}
