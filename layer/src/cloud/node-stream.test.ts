import { describe, expect, it, vi } from "vitest";
import { SourceError } from "../errors/index.js";
import { NodeStore, type OctreeNode, SharedBudget, type View } from "../octree/index.js";
import { insertPage } from "../octree/insert-page.fixture.js";
import type { HierarchyEntry } from "../sources/contract/point-source.js";
import type { NodeVertices } from "../workers/index.js";
import { NodeStream } from "./node-stream.js";

const POINTS = 5000;
const BYTES = POINTS * 20;

const entry = (depth: number, x: number, pointCount = POINTS): HierarchyEntry => ({
  ...{ depth, x: x & 1, y: (x >> 1) & 1, z: x >> 2, pointCount, address: { offset: 1000 + x, length: 32 } },
});

/** A root with `children` children, the first two along x, the last of them behind a further page if asked for. */
interface SetUp {
  readonly children?: number;
  readonly page?: boolean;
  readonly requests?: number;
  readonly cacheBytes?: number;
  readonly budget?: SharedBudget;
}

function setUp(options: SetUp = {}) {
  const { children = 2, page = false } = options;
  const store = new NodeStore("a.copc.laz", 1e6, { offset: 500, length: 32 });
  store.root.become("opening");
  const entries = Array.from({ length: children }, (_, x) => entry(1, x));
  if (page) entries[children - 1] = entry(1, children - 1, -1);
  insertPage(store, store.root, [entry(0, 0), ...entries]);
  const calls = new Map<
    string,
    { resolve: () => void; reject: (error: Error) => void; signal: AbortSignal }
  >();
  const wait = (name: string, signal: AbortSignal) =>
    new Promise<void>((resolve, reject) => {
      calls.set(name, { resolve, reject, signal });
      signal.addEventListener("abort", () => reject(signal.reason), { once: true });
    });
  const stream = new NodeStream(
    {
      store,
      boundsOf: ({ key }) => ({ x: 100 * key.x, y: 0, z: 0, radius: 10, spacing: 10 / 2 ** key.depth }),
      loadVertices: async (node, signal) => {
        await wait(node.name, signal);
        return { count: POINTS, bytes: BYTES } as NodeVertices;
      },
      openPage: async (node, signal) => {
        await wait(`page ${node.name}`, signal);
        insertPage(store, node, [entry(1, node.key.x)]);
      },
    },
    {
      ...{ requests: options.requests ?? 8, cacheBytes: options.cacheBytes ?? 1e9 },
      ...(options.budget && { budget: options.budget }),
    },
  );
  const answer = async (name: string, error?: Error) => {
    const call = calls.get(name);
    if (!call) throw new Error(`${name} was not asked for`);
    if (error) call.reject(error);
    else call.resolve();
    await nextTask();
  };
  return { stream, store, calls, answer };
}

const nextTask = () => new Promise((done) => setTimeout(done));

/** Sees everything, or only what lies within 20 m of a place on the x axis. */
function viewAt(x?: number): View {
  const planes = x === undefined ? [] : [1, 0, 0, 20 - x, -1, 0, 0, 20 + x];
  return {
    position: [0, 0, 500],
    direction: [0, 0, -1],
    planes,
    height: 1000,
    projection: { kind: "perspective", fieldOfView: 1 },
    horizon: false,
  };
}

const fault = {
  code: "SOURCE_HTTP",
  file: "a.copc.laz",
  cause: "the server is busy",
  fix: "Try again later",
};
const traversal = { maximumScreenSpaceError: 0.1, pointBudget: 1e6 };
const viewer = {};

describe("NodeStream", () => {
  it("loads what a view wants, the root first, and tells how far it is", async () => {
    const { stream, calls, answer } = setUp({ requests: 1 });
    stream.update(viewer, viewAt(), traversal);
    expect([...calls.keys()]).toEqual(["0-0-0-0"]);
    expect(stream.progress(viewer)).toEqual({ wanted: 3, ready: 0, failed: 0, pending: 3 });
    await answer("0-0-0-0");
    expect(stream.progress(viewer)).toEqual({ wanted: 3, ready: 1, failed: 0, pending: 2 });
    expect([calls.size, stream.active]).toEqual([2, 1]);
  });

  it("loads the root before any view asks for it, once, and stops that when destroyed", async () => {
    const { stream, calls, answer } = setUp();
    stream.loadRoot();
    stream.loadRoot();
    expect([[...calls.keys()], stream.active]).toEqual([["0-0-0-0"], 1]);
    const before = calls.get("0-0-0-0");
    stream.update(viewer, viewAt(), traversal);
    expect(calls.get("0-0-0-0")).toBe(before);
    await answer("0-0-0-0");
    expect(stream.progress(viewer)).toEqual({ wanted: 3, ready: 1, failed: 0, pending: 2 });
    const other = setUp();
    other.stream.loadRoot();
    other.stream.destroy();
    expect(other.calls.get("0-0-0-0")?.signal.aborted).toBe(true);
  });

  it("never asks for more at once than it may", async () => {
    const { stream, calls } = setUp({ requests: 2 });
    stream.update(viewer, viewAt(), traversal);
    expect(calls.size).toBe(2);
    await nextTask();
    expect(calls.size).toBe(2);
  });

  it("asks for several at once, and for more once half of them are here", async () => {
    const { stream, calls, answer } = setUp({ requests: 2 });
    stream.update(viewer, viewAt(), traversal);
    expect([...calls.keys()]).toEqual(["0-0-0-0", "1-0-0-0"]);
    await answer("0-0-0-0");
    expect(calls.size).toBe(3);
    const four = setUp({ requests: 4, children: 6 });
    four.stream.update(viewer, viewAt(), traversal);
    expect(four.calls.size).toBe(4);
    await four.answer("0-0-0-0");
    expect(four.calls.size).toBe(4);
    await four.answer("1-0-0-0");
    expect(four.calls.size).toBe(6);
  });

  it("asks for no node of which hardly anything shows, and shows it where it is here", async () => {
    const spacing = Math.max(...setUp().stream.update(viewer, viewAt(), traversal).spacings.slice(1));
    /** Shows this share of the nearer child. */
    const showing = (share: number) => ({
      ...traversal,
      maximumScreenSpaceError: spacing * Math.sqrt(4 / (1 + 3 * share)),
    });
    const { stream, store, calls, answer } = setUp();
    const { nodes, counts } = stream.update(viewer, viewAt(), showing(0.1));
    expect(counts.slice(1)).toEqual([500, 415]);
    expect(nodes.map(({ name }) => name)).toEqual(["0-0-0-0", "1-0-0-0", "1-1-0-0"]);
    expect([...calls.keys()]).toEqual(["0-0-0-0"]);
    await answer("0-0-0-0");
    expect(stream.progress(viewer)).toEqual({ wanted: 1, ready: 1, failed: 0, pending: 0 });
    stream.update(viewer, viewAt(), showing(0.15));
    await answer("1-0-0-0");
    expect(store.closest({ depth: 1, x: 0, y: 0, z: 0 }).state).toBe("ready");
    stream.update(viewer, viewAt(), showing(0.05));
    // The other child is on its way and goes on.
    expect(calls.get("1-1-0-0")?.signal.aborted).toBe(false);
    expect(stream.progress(viewer)).toEqual({ wanted: 2, ready: 2, failed: 0, pending: 0 });
  });

  it("stops what a view that moved on no longer wants, and can load it later", async () => {
    const { stream, store, calls, answer } = setUp();
    stream.update(viewer, viewAt(), traversal);
    await nextTask();
    stream.update(viewer, viewAt(0), traversal);
    expect(calls.get("1-1-0-0")?.signal.aborted).toBe(true);
    await answer("0-0-0-0");
    const node = store.closest({ depth: 1, x: 1, y: 0, z: 0 });
    expect(node.state).toBe("listed");
    stream.update(viewer, viewAt(), traversal);
    await answer("1-1-0-0");
    expect(node.state).toBe("ready");
  });

  it("reads a page when a view comes to it, then the nodes behind it", async () => {
    const { stream, answer } = setUp({ page: true });
    stream.update(viewer, viewAt(), traversal);
    expect(stream.progress(viewer)).toMatchObject({ wanted: 2, pending: 3 });
    await answer("page 1-1-0-0");
    stream.update(viewer, viewAt(), traversal);
    for (const name of ["0-0-0-0", "1-0-0-0", "1-1-0-0"]) await answer(name);
    expect(stream.progress(viewer)).toEqual({ wanted: 3, ready: 3, failed: 0, pending: 0 });
  });

  it("counts what failed as failed, tells of it once, and tries again only when asked to", async () => {
    const { stream, calls, answer } = setUp({ page: true });
    const failures: string[] = [];
    stream.subscribe({ nodeFailed: (node, error) => failures.push(`${node.name} ${error.message}`) });
    stream.update(viewer, viewAt(), traversal);
    await answer("0-0-0-0");
    await answer("1-0-0-0", new Error("damaged"));
    await answer("page 1-1-0-0", new Error("gone"));
    stream.update(viewer, viewAt(), traversal);
    expect(stream.progress(viewer)).toEqual({ wanted: 2, ready: 1, failed: 2, pending: 0 });
    expect(failures).toEqual(["1-0-0-0 damaged", "1-1-0-0 gone"]);
    calls.clear();
    stream.update(viewer, viewAt(), traversal);
    expect(calls.size).toBe(0);
    stream.retryFailed();
    stream.update(viewer, viewAt(), traversal);
    expect([...calls.keys()].sort()).toEqual(["1-0-0-0", "page 1-1-0-0"]);
  });

  it("goes on, and tells the others, where a listener throws", async () => {
    const reported: unknown[] = [];
    vi.stubGlobal("reportError", (error: unknown) => reported.push(error));
    const { stream, answer } = setUp();
    const told: string[] = [];
    const fault = new Error("of the application");
    const tell = (what: string) => {
      told.push(what);
      throw fault;
    };
    for (let listeners = 0; listeners < 2; listeners++) {
      stream.subscribe({
        nodeLoaded: ({ name }) => tell(`loaded ${name}`),
        nodeFailed: ({ name }) => tell(`failed ${name}`),
        nodeEvicted: ({ name }) => tell(`evicted ${name}`),
      });
    }
    stream.update(viewer, viewAt(), traversal);
    await answer("0-0-0-0");
    await answer("1-0-0-0", new Error("damaged"));
    expect([stream.active, stream.progress(viewer)]).toEqual([
      1,
      { wanted: 3, ready: 1, failed: 1, pending: 1 },
    ]);
    stream.destroy();
    const once = ["loaded 0-0-0-0", "failed 1-0-0-0", "evicted 0-0-0-0"];
    expect(told).toEqual(once.flatMap((what) => [what, what]));
    expect(reported).toEqual(told.map(() => fault));
    vi.unstubAllGlobals();
  });

  it("asks again for what its server cannot give for now, page or node, as long as a view wants it", async () => {
    vi.useFakeTimers();
    try {
      const { stream, calls, answer } = setUp({ page: true });
      const failures: string[] = [];
      stream.subscribe({ nodeFailed: (node) => failures.push(node.name) });
      const busy = new SourceError({ ...fault, outage: "busy" });
      const later = async (name: string, error?: Error) => {
        const answered = answer(name, error);
        await vi.advanceTimersByTimeAsync(0);
        return answered;
      };
      stream.update(viewer, viewAt(), traversal);
      await vi.advanceTimersByTimeAsync(0);
      for (const name of ["0-0-0-0", "1-0-0-0", "page 1-1-0-0"]) await later(name, busy);
      expect(stream.progress(viewer)).toMatchObject({
        ...{ wanted: 2, ready: 0, failed: 0, pending: 3, waiting: { outage: "busy", code: "SOURCE_HTTP" } },
      });
      calls.clear();
      // The view moves on from the second child: only what it wants still is asked for.
      stream.update(viewer, viewAt(0), traversal);
      await vi.advanceTimersByTimeAsync(1300);
      expect([...calls.keys()].sort()).toEqual(["0-0-0-0", "1-0-0-0"]);
      await later("0-0-0-0");
      await later("1-0-0-0");
      expect(stream.progress(viewer)).toEqual({ wanted: 2, ready: 2, failed: 0, pending: 0 });
      calls.clear();
      stream.update(viewer, viewAt(), traversal);
      expect([...calls.keys()]).toEqual(["page 1-1-0-0"]);
      stream.destroy();
      expect([failures, vi.getTimerCount()]).toEqual([[], 0]);
    } finally {
      vi.useRealTimers();
    }
  });

  it("gives up what was not wanted for longest once the cache is full, never what is wanted", async () => {
    const { stream, answer } = setUp({ cacheBytes: 2 * BYTES });
    const evicted: string[] = [];
    stream.subscribe({ nodeEvicted: (node: OctreeNode) => evicted.push(node.name) });
    stream.update(viewer, viewAt(), traversal);
    for (const name of ["0-0-0-0", "1-0-0-0", "1-1-0-0"]) await answer(name);
    stream.update(viewer, viewAt(), traversal);
    expect(evicted).toEqual([]);
    stream.update(viewer, viewAt(0), traversal);
    expect(evicted).toEqual(["1-1-0-0"]);
    expect(stream.bytes).toBe(2 * BYTES);
  });

  it("lets nodes end that have become too small by little, and asks for none of them anew", async () => {
    const { stream, store, calls, answer } = setUp();
    // A child is drawn from half the error on, and may end its way down to nine tenths of that.
    const error = (pixels: number) => ({ ...traversal, maximumScreenSpaceError: pixels });
    const [node] = stream.update(viewer, viewAt(), traversal).nodes.slice(1);
    const size = stream.update(viewer, viewAt(), traversal).spacings[1];
    stream.update(viewer, viewAt(), error(2.1 * size));
    expect(calls.get(node.name)?.signal.aborted).toBe(false);
    stream.update(viewer, viewAt(), error(2.3 * size));
    expect(calls.get(node.name)?.signal.aborted).toBe(true);
    await answer("0-0-0-0");
    calls.clear();
    stream.update(viewer, viewAt(), error(2.1 * size));
    expect([calls.size, store.root.state]).toEqual([0, "ready"]);
  });

  it("gives up what is oldest where several clouds together pass their bytes", async () => {
    const budget = new SharedBudget({ cpuBytes: 4 * BYTES });
    const first = setUp({ budget });
    const second = setUp({ budget });
    const other = {};
    first.stream.update(viewer, viewAt(), traversal);
    for (const name of ["0-0-0-0", "1-0-0-0", "1-1-0-0"]) await first.answer(name);
    second.stream.update(other, viewAt(0), traversal);
    for (const name of ["0-0-0-0", "1-0-0-0"]) await second.answer(name);
    expect(budget.cpu.used).toBe(5 * BYTES);
    // The first view shrinks: what it no longer wants goes first, until a fifth of the room is free.
    first.stream.update(viewer, viewAt(0), traversal);
    expect([first.stream.bytes, second.stream.bytes, budget.cpu.used]).toEqual([
      ...[2 * BYTES, 2 * BYTES, 4 * BYTES],
    ]);
    first.stream.detach(viewer);
    second.stream.destroy();
    expect(budget.cpu.used).toBe(first.stream.bytes);
    expect(budget.granted).toBe(0);
  });

  it("gives a budget back when a view has another one, or none", () => {
    const { stream } = setUp();
    const [first, second] = [new SharedBudget(), new SharedBudget()];
    const granted = [first, second, undefined].map((budget) => {
      stream.update(viewer, viewAt(), { ...traversal, budget });
      return [first.granted, second.granted];
    });
    expect(granted).toEqual([
      [3 * POINTS, 0],
      [0, 3 * POINTS],
      [0, 0],
    ]);
  });

  it("loads once what two views want, and keeps it while one of them stays", async () => {
    const { stream, calls, answer } = setUp();
    const other = {};
    stream.update(viewer, viewAt(), traversal);
    await nextTask();
    const first = calls.get("1-1-0-0");
    stream.update(other, viewAt(), traversal);
    stream.detach(viewer);
    expect(calls.get("1-1-0-0")).toBe(first);
    expect(first?.signal.aborted).toBe(false);
    await answer("1-1-0-0");
    expect(stream.progress(other).ready).toBe(1);
  });

  it("loads all that a view waits for after another has ended, without being told anew", async () => {
    const { stream, calls, answer } = setUp({ children: 8, requests: 2 });
    const other = {};
    stream.update(viewer, viewAt(), traversal);
    // Nearer to the other half of the children, so that nodes of both take turns.
    stream.update(other, { ...viewAt(), position: [1000, 0, 500] }, traversal);
    const answered = new Set<string>();
    const answerNext = async () => {
      const name = [...calls.keys()].find((asked) => !answered.has(asked)) ?? "";
      answered.add(name);
      await answer(name);
    };
    for (let answers = 0; answers < 3; answers++) await answerNext();
    stream.detach(other);
    while (stream.active > 0) await answerNext();
    expect(stream.progress(viewer)).toEqual({ wanted: 9, ready: 9, failed: 0, pending: 0 });
  });

  it("stops everything and holds nothing when destroyed", async () => {
    const { stream, calls, answer } = setUp();
    stream.update(viewer, viewAt(), traversal);
    await answer("0-0-0-0");
    stream.destroy();
    expect([...calls.values()].slice(1).every(({ signal }) => signal.aborted)).toBe(true);
    await nextTask();
    expect([stream.bytes, stream.active]).toEqual([0, 0]);
  });
});
