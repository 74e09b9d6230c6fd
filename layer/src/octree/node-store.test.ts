import { describe, expect, it } from "vitest";
import type { HierarchyEntry } from "../sources/contract/point-source.js";
import { insertPage } from "./insert-page.fixture.js";
import { NodeStore } from "./node-store.js";

const entry = (name: string, pointCount: number, offset = 1000): HierarchyEntry => {
  const [depth, x, y, z] = name.split("-").map(Number);
  return { depth, x, y, z, pointCount, address: { offset, length: 32 } };
};

function storeOf(entries: HierarchyEntry[], limit = 1000): NodeStore {
  const store = new NodeStore("a.copc.laz", limit, { offset: 500, length: 32 });
  store.root.become("opening");
  insertPage(store, store.root, entries);
  return store;
}

/** Pages by their node; the first has three, two of which are said to lie at the same place. */
const PAGES: Record<string, HierarchyEntry[]> = {
  "0-0-0-0": [
    ...[entry("0-0-0-0", 1), entry("1-0-0-0", -1, 600)],
    ...[entry("1-1-0-0", -1, 700), entry("1-0-1-0", -1, 600)],
  ],
  "1-0-0-0": [entry("1-0-0-0", 3), entry("2-0-0-0", 1)],
  "1-0-1-0": [entry("1-0-0-0", 3), entry("2-0-0-0", 1)],
  "1-1-0-0": [entry("1-1-0-0", 1), entry("2-2-0-0", -1, 800)],
  "2-2-0-0": [entry("2-2-0-0", 1)],
};

function paged(limit = 1000) {
  const store = storeOf(PAGES["0-0-0-0"], limit);
  const find = (name: string) => store.closest(entry(name, 0));
  const open = (name: string) => {
    const node = find(name);
    node.become("opening");
    insertPage(store, node, PAGES[name]);
    return node;
  };
  const known = (name: string) => (find(name).name === name ? find(name).state : undefined);
  return { store, open, known };
}

const unused = () => false;

const hierarchyError = expect.objectContaining({ code: "FORMAT_HIERARCHY" });

describe("NodeStore", () => {
  it("builds the tree in whatever order the entries come", () => {
    const store = storeOf([entry("2-1-1-0", 5), entry("1-0-0-0", 0), entry("0-0-0-0", 10)]);
    expect([store.size, store.points]).toEqual([3, 15]);
    expect(store.root.state).toBe("listed");
    expect(store.closest({ depth: 2, x: 1, y: 1, z: 0 }).name).toBe("2-1-1-0");
    expect(store.closest({ depth: 1, x: 0, y: 0, z: 0 }).state).toBe("empty");
  });

  it("puts in the empty nodes that some writers leave out", () => {
    const store = storeOf([entry("0-0-0-0", 10), entry("3-7-0-0", 5)]);
    expect(store.size).toBe(4);
    expect(store.closest({ depth: 2, x: 3, y: 0, z: 0 })).toMatchObject({ state: "empty", pointCount: 0 });
  });

  it("takes a further page in at its node", () => {
    const store = storeOf([entry("0-0-0-0", 10), entry("1-1-0-0", -1, 600)]);
    const page = store.closest({ depth: 1, x: 1, y: 0, z: 0 });
    expect(page.state).toBe("page");
    page.become("opening");
    insertPage(store, page, [entry("1-1-0-0", 7), entry("2-2-1-1", 3)]);
    expect([page.state, page.pointCount, store.points]).toEqual(["listed", 7, 20]);
  });

  it.each([
    ["a node named twice", [entry("0-0-0-0", 1), entry("1-0-0-0", 1), entry("1-0-0-0", 2)]],
    ["a root named twice", [entry("0-0-0-0", 1), entry("0-0-0-0", 1)]],
    ["a page that stands for itself", [entry("0-0-0-0", -1, 500)]],
    ["more points than the header says", [entry("0-0-0-0", 600), entry("1-0-0-0", 600)]],
    [
      "a node behind a page that is not read",
      [entry("0-0-0-0", 1), entry("1-0-0-0", -1), entry("2-0-0-0", 1)],
    ],
  ])("refuses %s", (_, entries) => {
    expect(() => storeOf(entries)).toThrow(hierarchyError);
  });

  it("refuses a page with nodes of another branch, and a loop of pages", () => {
    const first = [entry("0-0-0-0", 1), entry("1-0-0-0", -1, 600), entry("1-1-0-0", -1, 500)];
    const store = storeOf(first);
    const page = store.closest({ depth: 1, x: 0, y: 0, z: 0 });
    page.become("opening");
    expect(() => insertPage(store, page, [entry("1-1-0-0", 1)])).toThrow(hierarchyError);
    const loop = store.closest({ depth: 1, x: 1, y: 0, z: 0 });
    loop.become("opening");
    expect(() => insertPage(store, loop, first)).toThrow(hierarchyError);
    expect(() => insertPage(store, loop, [entry("1-1-0-0", -1, 600)])).toThrow(hierarchyError);
  });

  it("keeps nothing of a damaged page, so that it can be read again", () => {
    const store = storeOf([entry("0-0-0-0", 1), entry("1-0-0-0", -1, 600)]);
    const page = store.closest({ depth: 1, x: 0, y: 0, z: 0 });
    page.become("opening");
    expect(() => insertPage(store, page, [entry("1-0-0-0", 3), entry("2-3-3-3", 1)])).toThrow(hierarchyError);
    expect([page.state, store.points, store.size]).toEqual(["opening", 1, 2]);
    insertPage(store, page, [entry("1-0-0-0", 3)]);
    expect([page.state, store.points]).toEqual(["listed", 4]);
  });

  it("reads a page that was given up again as if it came for the first time", () => {
    const { store, open } = paged();
    const page = open("1-0-0-0");
    const before = [store.size, store.points];
    store.limit = 1;
    expect(store.trim(unused)).toBe(true);
    expect([page.state, page.pointCount, page.children, page.address]).toEqual([
      ...["page", 0, undefined, { offset: 600, length: 32 }],
    ]);
    expect([store.size, store.points]).toEqual([4, 1]);
    open("1-0-0-0");
    expect([store.size, store.points]).toEqual(before);
  });

  it("gives up first what was used longest ago, no more than needed, and what lies below it too", () => {
    const { store, open, known } = paged();
    for (const name of ["1-0-0-0", "1-1-0-0", "2-2-0-0"]) open(name);
    const first = store.closest({ depth: 1, x: 0, y: 0, z: 0 });
    if (first.page) store.use(first.page);
    store.limit = store.size - 1;
    store.trim(unused);
    expect([known("1-0-0-0"), known("1-1-0-0"), known("2-2-0-0")]).toEqual(["listed", "page", undefined]);
  });

  it("gives up nothing that is in use, held, or above what is held, and never the first page", () => {
    const { store, open, known } = paged();
    for (const name of ["1-0-0-0", "1-1-0-0", "2-2-0-0"]) open(name);
    const below = store.closest({ depth: 2, x: 2, y: 0, z: 0 });
    below.become("queued");
    store.limit = 1;
    store.trim(({ root }) => root.name === "1-0-0-0");
    expect([known("1-0-0-0"), known("1-1-0-0"), known("2-2-0-0")]).toEqual(["listed", "listed", "queued"]);
    below.become("listed");
    store.trim(unused);
    expect([store.root.state, store.size]).toEqual(["listed", 4]);
    expect(() => below.become("queued")).toThrow("2-2-0-0 has left the octree");
  });

  it("does not take a page back in that was given up, however late it is said to be in use", () => {
    const { store, open } = paged();
    const { page } = open("1-0-0-0");
    store.limit = 1;
    expect([store.trim(unused), store.trim(unused)]).toEqual([true, false]);
    const { size, points } = store;
    store.use(page!);
    expect([store.trim(unused), store.size, store.points]).toEqual([false, size, points]);
    expect(page!.dropped).toBe(true);
  });

  it("knows where the points of a node are, and of one without points nothing", () => {
    const store = storeOf([entry("0-0-0-0", 0, 1), entry("1-0-0-0", 5, 2), entry("1-1-0-0", 0, 3)]);
    const at = (name: string) => store.closest(entry(name, 0));
    expect([store.root.state, store.root.address]).toEqual(["empty", undefined]);
    expect([at("1-0-0-0").state, at("1-0-0-0").address]).toEqual(["listed", { offset: 2, length: 32 }]);
    expect([at("1-1-0-0").state, at("1-1-0-0").address]).toEqual(["empty", undefined]);
    expect(() => store.draft(at("1-1-0-0"))).toThrow("node 1-1-0-0 has no page");
  });

  it("refuses a page that two nodes share, given up or not", () => {
    const { store, open } = paged();
    open("1-0-0-0");
    expect(() => open("1-0-1-0")).toThrow(hierarchyError);
    store.limit = 1;
    store.trim(unused);
    const again = store.closest({ depth: 1, x: 0, y: 1, z: 0 });
    expect(() => insertPage(store, again, PAGES["1-0-0-0"])).toThrow(hierarchyError);
  });

  it("never lets more points in than the header says, whatever was given up", () => {
    const { store, open } = paged(5);
    for (let round = 0; round < 5; round++) {
      open("1-0-0-0");
      store.limit = 1;
      store.trim(unused);
    }
    open("1-0-0-0");
    expect(() => open("1-1-0-0")).toThrow(hierarchyError);
  });

  it("shows nothing of a page until all of it is there", () => {
    const { store } = paged();
    const node = store.closest({ depth: 1, x: 1, y: 0, z: 0 });
    node.become("opening");
    const draft = store.draft(node);
    for (const taken of PAGES["1-1-0-0"]) draft.take(taken);
    expect(draft.grow(1)).toBe(true);
    expect([store.closest({ depth: 2, x: 2, y: 0, z: 0 }), store.size, node.pointCount]).toEqual([
      node,
      4,
      0,
    ]);
    expect(draft.grow(1)).toBe(false);
    store.insertPage(draft);
    expect([store.closest({ depth: 2, x: 2, y: 0, z: 0 }).state, store.size]).toEqual(["page", 5]);
  });
});
