import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { NodeStore } from "../octree/index.js";
import { entriesOfPage } from "../sources/copc/hierarchy.js";
import { pageBytes } from "../sources/copc/tiny-copc.fixture.js";
import { openPage } from "./open-page.js";

/** A flat octree of seven levels in one page. */
const rows = Array.from({ length: 7 }, (_, depth) =>
  Array.from({ length: 4 ** depth }, (_, index) => {
    const edge = 2 ** depth;
    return [depth, index % edge, Math.floor(index / edge), 0, 1000, 32, 1];
  }),
).flat();

const address = { offset: 500, length: 32 * rows.length };
const limits = { file: "a.copc.laz", fileSize: 1e6, pointsOffset: 700, pointCount: 1e6, recordLength: 36 };
const source = { page: async () => entriesOfPage(pageBytes(rows), limits) };

function opening() {
  const store = new NodeStore("a.copc.laz", 1e6, address);
  store.root.become("opening");
  return store;
}

/** Lets whoever waits for a turn have it. */
const turn = () => new Promise((resolve) => setImmediate(resolve));

describe("openPage", () => {
  // A machine on which every look at the clock finds the time used up.
  beforeEach(() => {
    let now = 0;
    vi.spyOn(performance, "now").mockImplementation(() => (now += 100));
  });
  afterEach(() => vi.restoreAllMocks());

  it("gives the thread back on the way, and shows the page only once all of it is there", async () => {
    const store = opening();
    let done = false;
    const reading = openPage(source, store, store.root, undefined).finally(() => {
      done = true;
    });
    let turns = 0;
    for (await turn(); !done; await turn(), turns++) {
      if (!done)
        expect([store.size, store.root.state, store.root.children]).toEqual([1, "opening", undefined]);
    }
    await reading;
    expect(turns).toBeGreaterThan(5);
    expect([store.size, store.points, store.root.state]).toEqual([rows.length, rows.length, "listed"]);
  });

  it("stops on the way, with nothing of the page left, and can begin anew", async () => {
    const store = opening();
    const controller = new AbortController();
    const reading = openPage(source, store, store.root, controller.signal);
    await turn();
    controller.abort(new Error("no longer"));
    await expect(reading).rejects.toThrow("no longer");
    expect([store.size, store.root.children, store.root.address]).toEqual([1, undefined, address]);
    await openPage(source, store, store.root, undefined);
    expect(store.size).toBe(rows.length);
  });
});
