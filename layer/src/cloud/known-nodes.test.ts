import fc from "fast-check";
import { describe, expect, it } from "vitest";
import type { HierarchyPage, NodeStore, OctreeNode, Selection } from "../octree/index.js";
import { insertPage } from "../octree/insert-page.fixture.js";
import { isHeld } from "../octree/node-state.js";
import {
  boundsOf,
  EDGE,
  type PagedOctree,
  pagedOctree,
  storeOf,
  viewAbove,
} from "../query/paged-octree.fixture.js";
import type { NodeVertices } from "../workers/index.js";
import { NodeStream } from "./node-stream.js";

const traversal = { maximumScreenSpaceError: 4, pointBudget: 1e6 };
const VERTICES = { count: 50, bytes: 1000 } as NodeVertices;

/** A stream over an octree whose pages and points come a turn after they were asked for. */
class Streamed {
  readonly store: NodeStore;
  readonly stream: NodeStream;
  readonly read: unknown[] = [];
  failing = false;

  constructor(octree: PagedOctree, knownNodes: number) {
    this.store = storeOf(octree);
    const answer = async (signal: AbortSignal) => {
      await turn();
      signal.throwIfAborted();
      if (this.failing) throw new Error("gone");
    };
    const open = (node: OctreeNode) => {
      this.read.push(node.address);
      insertPage(this.store, node, octree.pages.get(node.address) ?? []);
    };
    this.stream = new NodeStream(
      {
        store: this.store,
        boundsOf,
        loadVertices: (_, signal) => answer(signal).then(() => VERTICES),
        openPage: (node, signal) => answer(signal).then(() => open(node)),
      },
      { knownNodes, cacheBytes: 4 * VERTICES.bytes },
    );
    this.store.root.become("opening");
    open(this.store.root);
  }

  /** Shows a view until all pages that it needs are here. */
  async settle(viewer: object, view: ReturnType<typeof viewAbove>) {
    for (let frame = 0; frame < 100; frame++) {
      const selection = this.stream.update(viewer, view, traversal);
      if (selection.pages.length === 0) return selection;
      await turn();
    }
    throw new Error("the view never came to an end");
  }
}

const turn = () => new Promise<void>((resolve) => setImmediate(resolve));

/** Walks all that is known and holds the store's and the pages' accounts against it. */
function checkAccounts(store: NodeStore): void {
  const nodes: OctreeNode[] = [store.root];
  const held = new Set<HierarchyPage>();
  const known = new Map<HierarchyPage, { nodes: number; points: number }>();
  const broken: string[] = [];
  for (const node of nodes) {
    for (const child of node.children ?? []) if (child) nodes.push(child);
    const { page, state } = node;
    if (!page) continue;
    const account = (of: HierarchyPage) => {
      const found = known.get(of) ?? { nodes: 0, points: 0 };
      known.set(of, found);
      return found;
    };
    account(page).points += node.pointCount;
    // The root of a page is listed in the page above.
    const lister = node === page.root ? page.above : page;
    if (lister) account(lister).nodes++;
    if (page.dropped) broken.push(`${node.name} of a dropped page`);
    if ((state === "page" || state === "opening") && (node.children || node.pointCount > 0))
      broken.push(`${node.name} has content before its page is read`);
    for (let at = isHeld(state) ? page : undefined; at; at = at.above) held.add(at);
  }
  for (const [page, { nodes, points }] of known) {
    if (page.nodes !== nodes || page.points !== points) broken.push(`account of page ${page.root.name}`);
    if (page.held !== held.has(page)) broken.push(`holds of page ${page.root.name}`);
    if (page.above && !page.above.below.has(page)) broken.push(`page ${page.root.name} below no other`);
  }
  expect(broken).toEqual([]);
  expect([store.size, store.points]).toEqual([
    nodes.length,
    nodes.reduce((sum, { pointCount }) => sum + pointCount, 0),
  ]);
}

/** Nothing that a view shows, or goes through, may have left the octree. */
function checkUse({ nodes, pages, fringe, open }: Selection): void {
  const gone = [...nodes, ...pages, ...fringe].filter(({ page }) => page?.dropped);
  expect([...gone, ...open.filter(({ dropped }) => dropped).map(({ root }) => root)]).toEqual([]);
}

const place = fc.double({ min: 0, max: EDGE, noNaN: true });
const view = fc.tuple(place, place, fc.double({ min: 10, max: EDGE / 4, noNaN: true }));
const step = fc.record({
  viewer: fc.constantFrom(0, 1),
  view,
  frames: fc.integer({ min: 1, max: 4 }),
  next: fc.constantFrom("nothing", "nothing", "detach", "fail", "retry", "settle", "settle"),
});

type Step = typeof step extends fc.Arbitrary<infer T> ? T : never;

const shown = ({ nodes, counts, spacings }: Selection) =>
  nodes.map((node, index) => [node.name, counts[index], spacings[index]]);

describe("the nodes known", () => {
  it("are forgotten without a trace, and come again with all they had", async () => {
    let forgotten = 0;
    const run = async (seed: number, limit: number, steps: readonly Step[]) => {
      const octree = pagedOctree(seed);
      const few = new Streamed(octree, limit);
      const all = new Streamed(octree, Number.POSITIVE_INFINITY);
      const viewers = [{}, {}];
      const shownNow = new Map<number, Selection>();
      for (const { viewer, view, frames, next } of steps) {
        const looks = viewAbove(...view);
        few.failing = next === "fail";
        for (let frame = 0; frame < frames; frame++) {
          shownNow.set(viewer, few.stream.update(viewers[viewer], looks, traversal));
          checkAccounts(few.store);
          for (const selection of shownNow.values()) checkUse(selection);
          await turn();
        }
        few.failing = false;
        if (next === "detach") {
          few.stream.detach(viewers[viewer]);
          shownNow.delete(viewer);
        }
        if (next === "retry") few.stream.retryFailed();
        if (next !== "settle") continue;
        few.stream.retryFailed();
        const selection = await few.settle(viewers[viewer], looks);
        shownNow.set(viewer, selection);
        expect(shown(selection)).toEqual(shown(await all.settle(viewers[viewer], looks)));
        checkAccounts(few.store);
      }
      forgotten += few.read.length - new Set(few.read).size;
      for (const { stream } of [few, all]) stream.destroy();
    };
    await fc.assert(
      fc.asyncProperty(
        fc.integer(),
        fc.integer({ min: 1, max: 200 }),
        fc.array(step, { minLength: 8, maxLength: 20 }),
        run,
      ),
      { numRuns: 80 },
    );
    // The limits were such that pages really went and came.
    expect(forgotten).toBeGreaterThan(50);
  });

  it("stay within the limit whatever was seen before", async () => {
    const limit = 100;
    const streamed = new Streamed(pagedOctree(3), limit);
    const viewer = {};
    let most = 0;
    for (let at = 0; at < 64; at++) {
      const [x, y] = [at % 8, Math.floor(at / 8)].map((index) => (index * EDGE) / 8);
      await streamed.settle(viewer, viewAbove(x, y, EDGE / 8));
      most = Math.max(most, streamed.store.size);
    }
    expect(most).toBeGreaterThan(limit);
    while (streamed.stream.active > 0) await turn();
    streamed.stream.destroy();
    expect(streamed.store.size).toBeLessThanOrEqual(limit);
  });
});
