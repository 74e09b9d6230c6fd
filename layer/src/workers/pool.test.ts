import { describe, expect, it } from "vitest";
import { DecodeError } from "../errors/index.js";
import { type WorkerLike, WorkerPool } from "./pool.js";
import type {
  DataSetSpec,
  NodeJob,
  NodeRecords,
  NodeVertices,
  WorkerReply,
  WorkerRequest,
} from "./protocol.js";

/** A worker that answers when told to. */
class FakeWorker implements WorkerLike {
  onmessage: WorkerLike["onmessage"] = null;
  onerror: WorkerLike["onerror"] = null;
  onmessageerror: WorkerLike["onmessageerror"] = null;
  readonly heard: WorkerRequest[] = [];
  terminated = false;

  postMessage(message: WorkerRequest): void {
    this.heard.push(message);
  }

  terminate(): void {
    this.terminated = true;
  }

  get job() {
    return this.heard.filter((request) => request.kind === "node").at(-1);
  }

  reply(
    reply: Omit<Extract<WorkerReply, { kind: "failed" }>, "id"> | { kind: "vertices"; result: NodeVertices },
  ): void {
    this.onmessage?.({ data: { ...reply, id: this.job?.id } } as MessageEvent<WorkerReply>);
  }

  done(): void {
    this.reply({ kind: "vertices", result: vertices });
  }

  die(message = "crashed"): void {
    this.onerror?.({ message, preventDefault: () => undefined } as ErrorEvent);
  }
}

const vertices = { count: 1 } as NodeVertices;
const spec = { file: "a.copc.laz" } as DataSetSpec;

function setUp(size: number, jobTimeout?: number) {
  const workers: FakeWorker[] = [];
  const pool = new WorkerPool({
    size,
    jobTimeout,
    createWorker: () => {
      workers.push(new FakeWorker());
      return workers[workers.length - 1];
    },
  });
  const dataSet = pool.addDataSet(spec);
  const job = (node = "0-0-0-0"): NodeJob => ({
    ...{ dataSet, chunk: new ArrayBuffer(8), pointCount: 1, node, cube: [0, 0, 0, 1] },
    appearance: undefined,
  });
  return { pool, workers, job, dataSet };
}

describe("WorkerPool", () => {
  it("makes one worker ahead of the first job, which gets it", async () => {
    const { pool, workers, job } = setUp(2);
    pool.warm();
    pool.warm();
    expect(workers).toHaveLength(1);
    const result = pool.run(job());
    expect(workers).toHaveLength(1);
    workers[0].done();
    await expect(result).resolves.toBe(vertices);
  });

  it("leaves it to the first job to say that there can be no workers", async () => {
    const pool = new WorkerPool({
      createWorker: () => {
        throw new Error("no workers here");
      },
    });
    pool.warm();
    const job = { dataSet: pool.addDataSet(spec), pointCount: 1, node: "0-0-0-0" } as NodeJob;
    await expect(pool.run(job)).rejects.toThrow("no workers here");
  });

  it("makes workers as needed, tells each of the data set once and gives each one job at a time", async () => {
    const { pool, workers, job } = setUp(2);
    const results = [pool.run(job("a")), pool.run(job("b")), pool.run(job("c"))];
    expect(workers.map(({ heard }) => heard.map(({ kind }) => kind))).toEqual([
      ["dataSet", "node"],
      ["dataSet", "node"],
    ]);
    expect(pool.pending).toBe(3);
    workers[0].done();
    workers[0].done();
    workers[1].done();
    await expect(Promise.all(results)).resolves.toHaveLength(3);
    expect(workers[0].heard.filter(({ kind }) => kind === "dataSet")).toHaveLength(1);
    expect(pool.pending).toBe(0);
  });

  it("has a bounded number of points in hand, and a node of more goes alone", async () => {
    const { pool, workers, job } = setUp(4);
    const many = { ...job("many"), pointCount: 2 ** 21 };
    const results = [pool.run(job("a")), pool.run(many), pool.run(job("b"))];
    expect(workers).toHaveLength(1);
    workers[0].done();
    expect(workers[0].heard.at(-1)).toMatchObject({ job: { node: "many" } });
    workers[0].done();
    workers[0].done();
    await expect(Promise.all(results)).resolves.toHaveLength(3);
  });

  it("drops a job that is aborted while it waits, and never sends it", async () => {
    const { pool, workers, job } = setUp(1);
    const first = pool.run(job("a"));
    const controller = new AbortController();
    const second = pool.run(job("b"), controller.signal);
    controller.abort();
    await expect(second).rejects.toThrow(expect.objectContaining({ name: "AbortError" }));
    workers[0].done();
    await first;
    expect(workers[0].heard.filter(({ kind }) => kind === "node")).toHaveLength(1);
    expect(pool.pending).toBe(0);
  });

  it("rejects at once a running job that is aborted, and goes on with the worker afterwards", async () => {
    const { pool, workers, job } = setUp(1);
    const controller = new AbortController();
    const first = pool.run(job("a"), controller.signal);
    const second = pool.run(job("b"));
    controller.abort();
    await expect(first).rejects.toThrow(expect.objectContaining({ name: "AbortError" }));
    workers[0].done();
    workers[0].done();
    await expect(second).resolves.toBe(vertices);
    expect(workers).toHaveLength(1);
  });

  it("revives the worker's error with its class and code", async () => {
    const { pool, workers, job } = setUp(1);
    const result = pool.run(job());
    const fault = { kind: "DecodeError", code: "DECODE_CHUNK", file: "f", cause: "c", fix: "x" };
    workers[0].reply({ kind: "failed", fault });
    await expect(result).rejects.toThrow(
      expect.objectContaining({ name: "DecodeError", code: "DECODE_CHUNK" }),
    );
  });

  it("gives the job of a worker that died to another one", async () => {
    const { pool, workers, job } = setUp(1);
    const result = pool.run(job());
    workers[0].die();
    expect([workers.length, workers[0].terminated]).toEqual([2, true]);
    workers[1].done();
    await expect(result).resolves.toBe(vertices);
  });

  it("gives up a job over which two workers died, and does the next", async () => {
    const { pool, workers, job } = setUp(1);
    const deadly = pool.run(job("a"));
    const next = pool.run(job("b"));
    workers[0].die();
    workers[1].die();
    await expect(deadly).rejects.toThrow(expect.objectContaining({ code: "DECODE_WORKER" }));
    await expect(deadly).rejects.toBeInstanceOf(DecodeError);
    workers[2].done();
    await expect(next).resolves.toBe(vertices);
  });

  it("says where there are no workers what to give in their place, and keeps nothing waiting", async () => {
    const pool = new WorkerPool();
    pool.warm();
    const { job } = setUp(1);
    for (let times = 0; times < 2; times++) {
      await expect(pool.records(job())).rejects.toThrow(
        /^DECODE_WORKER: .* new LocalExecutor\(new LazDecoder\(load\)\), where load reads the file @groma\/layer\/laz\.wasm/,
      );
      expect(pool.pending).toBe(0);
    }
  });

  it("takes a worker that does not answer for dead", async () => {
    const { pool, workers, job } = setUp(1, 10);
    await expect(pool.run(job())).rejects.toThrow(expect.objectContaining({ code: "DECODE_WORKER" }));
    expect(workers.every(({ terminated }) => terminated)).toBe(true);
  });

  it("makes its workers forget a data set that is removed", async () => {
    const { pool, workers, job, dataSet } = setUp(1);
    const result = pool.run(job());
    workers[0].done();
    await result;
    pool.removeDataSet(dataSet);
    expect(workers[0].heard.at(-1)).toEqual({ kind: "forget", id: dataSet });
    await expect(pool.run(job())).rejects.toThrow("never added or is removed");
  });

  it("ends all workers and open jobs when destroyed", async () => {
    const { pool, workers, job } = setUp(1);
    const open = [pool.run(job("a")), pool.run(job("b"))];
    pool.destroy();
    for (const result of open)
      await expect(result).rejects.toThrow(expect.objectContaining({ name: "AbortError" }));
    expect(workers[0].terminated).toBe(true);
    await expect(pool.run(job())).rejects.toThrow(expect.objectContaining({ name: "AbortError" }));
  });

  it("has records decoded by the same workers, and takes no other answer for them", async () => {
    const { pool, workers, job } = setUp(1);
    const { appearance: _, ...chunk } = job();
    const records: NodeRecords = {
      count: 1,
      xyz: new Int32Array(3),
      attributes: [],
      order: new Uint16Array(1),
    };
    const asked = pool.records(chunk);
    const { id } = workers[0].heard.at(-1) as Extract<WorkerRequest, { kind: "records" }>;
    workers[0].onmessage?.({ data: { kind: "records", id, result: records } } as MessageEvent<WorkerReply>);
    await expect(asked).resolves.toBe(records);
    const mixed = pool.run(job());
    const next = workers[0].heard.at(-1) as Extract<WorkerRequest, { kind: "node" }>;
    workers[0].onmessage?.({
      data: { kind: "records", id: next.id, result: records },
    } as MessageEvent<WorkerReply>);
    await expect(mixed).rejects.toThrow("something else");
  });
});
