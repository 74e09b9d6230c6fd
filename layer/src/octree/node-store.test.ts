import { describe, expect, it } from "vitest";
import type { HierarchyEntry } from "../sources/index.js";
import { NodeStore } from "./node-store.js";

const entry = (name: string, pointCount: number, offset = 1000): HierarchyEntry => {
  const [depth, x, y, z] = name.split("-").map(Number);
  return { depth, x, y, z, pointCount, address: { offset, length: 32 } };
};

function storeOf(entries: HierarchyEntry[], limit = 1000): NodeStore {
  const store = new NodeStore("a.copc.laz", limit, { offset: 500, length: 32 });
  store.root.become("opening");
  store.insertPage(store.root, entries);
  return store;
}

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
    store.insertPage(page, [entry("1-1-0-0", 7), entry("2-2-1-1", 3)]);
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
    const store = storeOf([entry("0-0-0-0", 1), entry("1-0-0-0", -1, 600), entry("1-1-0-0", -1, 500)]);
    const page = store.closest({ depth: 1, x: 0, y: 0, z: 0 });
    page.become("opening");
    expect(() => store.insertPage(page, [entry("1-1-0-0", 1)])).toThrow(hierarchyError);
    const loop = store.closest({ depth: 1, x: 1, y: 0, z: 0 });
    loop.become("opening");
    expect(() => store.insertPage(loop, [entry("1-1-0-0", 1)])).toThrow(hierarchyError);
  });

  it("keeps nothing of a damaged page, so that it can be read again", () => {
    const store = storeOf([entry("0-0-0-0", 1), entry("1-0-0-0", -1, 600)]);
    const page = store.closest({ depth: 1, x: 0, y: 0, z: 0 });
    page.become("opening");
    expect(() => store.insertPage(page, [entry("1-0-0-0", 3), entry("2-3-3-3", 1)])).toThrow(hierarchyError);
    expect([page.state, store.points, store.size]).toEqual(["opening", 1, 2]);
    store.insertPage(page, [entry("1-0-0-0", 3)]);
    expect([page.state, store.points]).toEqual(["listed", 4]);
  });
});
