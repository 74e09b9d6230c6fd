import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { keyName, type NodeStore, type OctreeNode, type VoxelKey } from "../octree/index.js";
import type { NodeRecords } from "../workers/index.js";
import { openPage } from "./open-page.js";
import { EDGE, type PagedOctree, pagedOctree, storeOf } from "./paged-octree.fixture.js";
import { type PointBatch, PointQuery, type QueryOptions, type QueryParts } from "./point-query.js";

/** Lets all that is waiting go on, as a request does. */
const turnOfTheLoop = () => new Promise((resolve) => setImmediate(resolve));

/** Spacing of the root, metres. */
const SPACING = 128;

/** Seed of an octree whose root has points. */
const ROOTED = 2;

/** A StyleError STYLE_OPTION that says this, in whatever case it begins. */
const refusal = (message: string) =>
  expect.objectContaining({
    code: "STYLE_OPTION",
    file: "flat.copc.laz",
    message: expect.stringMatching(new RegExp(message.replace(/[.?*]/g, "\\$&"), "i")),
  });

/** Points of a node of the flat octree: spread over its square, at integer metres. */
function pointsOf({ depth, x, y }: VoxelKey, count: number): Int32Array {
  const edge = EDGE / 2 ** depth;
  const xyz = new Int32Array(3 * count);
  for (let point = 0; point < count; point++) {
    xyz[3 * point] = Math.floor(x * edge + ((point * 7919) % edge));
    xyz[3 * point + 1] = Math.floor(y * edge + ((point * 104729) % edge));
  }
  return xyz;
}

/** What a query of an octree in memory works with, and what it asked for. */
function partsOf(octree: PagedOctree, store: NodeStore = storeOf(octree)) {
  const asked = { pages: 0, chunks: 0, atOnce: 0, most: 0 };
  const opening = new Map<OctreeNode, Promise<void>>();
  const source = {
    page: async (address: unknown) => {
      asked.pages++;
      for (let turn = 0; turn < asked.pages % 3; turn++) await turnOfTheLoop();
      return octree.pages.get(address)!;
    },
  };
  const parts: QueryParts = {
    file: "flat.copc.laz",
    async withNode(key, signal, work) {
      for (;;) {
        const node = store.closest(key);
        if (node.state === "page") {
          node.become("opening");
          opening.set(node, openPage(source, store, node, signal));
        }
        if (node.state !== "opening") return work(node);
        await opening.get(node);
      }
    },
    async records(node) {
      asked.chunks++;
      asked.atOnce++;
      asked.most = Math.max(asked.most, asked.atOnce);
      for (let turn = 0; turn < 1 + (asked.chunks % 2); turn++) await turnOfTheLoop();
      asked.atOnce--;
      const xyz = pointsOf(node.key, node.pointCount);
      const order = new Uint16Array(node.pointCount);
      return { xyz, count: node.pointCount, attributes: [], order } satisfies NodeRecords;
    },
    box({ depth, x, y }, out) {
      const edge = EDGE / 2 ** depth;
      out.set([x * edge, y * edge, 0, (x + 1) * edge, (y + 1) * edge, 0]);
      return out;
    },
    spacing: SPACING,
    scale: [1, 1, 1],
    offset: [0, 0, 0],
  };
  return { parts, asked };
}

/** A disc, for which boxes are judged conservatively. */
function disc(centreX: number, centreY: number, radius: number): NonNullable<QueryOptions["volume"]> {
  return {
    toBox(box) {
      const reach = (axis: number, centre: number) =>
        Math.max(Math.abs(box[axis] - centre), Math.abs(box[axis + 3] - centre));
      if (Math.hypot(reach(0, centreX), reach(1, centreY)) <= radius) return "in";
      const gap = (axis: number, centre: number) => Math.max(0, box[axis] - centre, centre - box[axis + 3]);
      return Math.hypot(gap(0, centreX), gap(1, centreY)) > radius ? "out" : "crossing";
    },
    contains: (x, y) => Math.hypot(x - centreX, y - centreY) <= radius,
  };
}

/** All nodes with points that the pages list, straight from their entries. */
function listed(octree: PagedOctree): VoxelKey[] {
  return [...octree.pages.values()].flat().filter(({ pointCount }) => pointCount > 0);
}

async function all(query: PointQuery): Promise<PointBatch[]> {
  const batches: PointBatch[] = [];
  for await (const batch of query.batches()) batches.push(batch);
  return batches;
}

const total = (batches: readonly PointBatch[]) => batches.reduce((sum, { inside }) => sum + inside.length, 0);

describe("PointQuery", () => {
  it("brings each node once, coarser levels first, and every point", async () => {
    for (let seed = 0; seed < 8; seed++) {
      const octree = pagedOctree(seed);
      const batches = await all(new PointQuery(partsOf(octree).parts, {}));
      expect(new Set(batches.map(({ node }) => node)).size).toBe(batches.length);
      expect(batches.map(({ node }) => node).sort()).toEqual(listed(octree).map(keyName).sort());
      const depths = batches.map(({ key }) => key.depth);
      expect(depths).toEqual([...depths].sort((a, b) => a - b));
      expect(total(batches)).toBe(octree.points);
      for (const { inside, records } of batches) {
        expect([...inside]).toEqual(Array.from({ length: records.count }, (_, index) => index));
      }
    }
  });

  it("brings just the points in a volume, and brackets their number beforehand", async () => {
    const place = fc.integer({ min: -200, max: EDGE + 200 });
    const volumes = fc.record({ x: place, y: place, radius: fc.integer({ min: 0, max: 900 }) });
    await fc.assert(
      fc.asyncProperty(fc.integer(), volumes, async (seed, { x, y, radius }) => {
        const octree = pagedOctree(seed);
        const volume = disc(x, y, radius);
        const expected = listed(octree).flatMap((key) => {
          const xyz = pointsOf(key, 50);
          const inside = Array.from(xyz.filter((_, at) => at % 3 === 0).keys()).filter((point) =>
            volume.contains(xyz[3 * point], xyz[3 * point + 1], 0),
          );
          return inside.map((point) => `${keyName(key)} ${point}`);
        });
        const { parts, asked } = partsOf(octree);
        const query = new PointQuery(parts, { volume });
        const { least, most, nodes } = await query.bracket();
        expect(asked.chunks).toBe(0);
        const batches = await all(query);
        const found = batches.flatMap(({ node, inside }) => [...inside].map((point) => `${node} ${point}`));
        expect(found.sort()).toEqual(expected.sort());
        expect(batches.filter(({ inside }) => inside.length === 0)).toEqual([]);
        expect(least).toBeLessThanOrEqual(found.length);
        expect(most).toBeGreaterThanOrEqual(found.length);
        expect(asked.chunks).toBe(nodes);
      }),
      { numRuns: 30 },
    );
  });

  it("counts exactly where no node crosses the volume, and reads no page that the volume misses", async () => {
    const octree = pagedOctree(3);
    const whole = await new PointQuery(partsOf(octree).parts, {}).bracket();
    expect(whole).toEqual({ least: octree.points, most: octree.points, nodes: listed(octree).length });
    const { parts, asked } = partsOf(octree);
    const missed = await new PointQuery(parts, { volume: disc(-1e6, 0, 1) }).bracket();
    expect(missed).toEqual({ least: 0, most: 0, nodes: 0 });
    expect(asked.pages).toBe(0);
  });

  it.each([
    [SPACING, 0],
    [SPACING / 2, 1],
    [SPACING / 3, 2],
    [SPACING / 4, 2],
    [10 * SPACING, 0],
    [0, 5],
  ])("stops at the first level as dense as %d m: %d", async (spacing, deepest) => {
    const octree = pagedOctree(ROOTED);
    const batches = await all(new PointQuery(partsOf(octree).parts, { spacing }));
    const wanted = listed(octree).filter(({ depth }) => depth <= deepest);
    expect(batches.map(({ node }) => node).sort()).toEqual(wanted.map(keyName).sort());
    expect(Math.max(...batches.map(({ key }) => key.depth))).toBe(deepest);
  });

  it("reads a few nodes ahead and no more while nobody takes them", async () => {
    const { parts, asked } = partsOf(pagedOctree(5));
    const signals: AbortSignal[] = [];
    let deepest = 0;
    const watched: QueryParts = {
      ...parts,
      withNode: (key, signal, work) => {
        deepest = Math.max(deepest, key.depth);
        return parts.withNode(key, signal, work);
      },
      records: (node, signal) => {
        signals.push(signal);
        return parts.records(node, signal);
      },
    };
    const batches = new PointQuery(watched, {}).batches();
    for (let taken = 1; ; taken++) {
      const { value } = await batches.next();
      if (value!.key.depth < 3) continue;
      await new Promise((resolve) => setTimeout(resolve, 50));
      expect(asked.chunks).toBe(taken + 5);
      break;
    }
    // Dozens of nodes of this level are still to be read before the next one is looked at.
    expect(deepest).toBe(3);
    expect(asked.most).toBe(6);
    await batches.return();
    expect(signals.length).toBe(asked.chunks);
    for (const { aborted } of signals) expect(aborted).toBe(true);
  });

  it("asks the volume for each point once, where it is, and lets others have the thread in between", async () => {
    const count = 3 * 2048 + 500;
    const xyz = Int32Array.from({ length: 3 * count }, (_, at) => 11 * at - 40_000);
    const octree: PagedOctree = {
      pages: new Map([[1, [{ depth: 0, x: 0, y: 0, z: 0, pointCount: count, address: 1 }]]]),
      points: count,
      first: 1,
    };
    const parts: QueryParts = {
      ...partsOf(octree).parts,
      records: async () => ({ xyz, count, attributes: [], order: new Uint16Array(count) }),
      scale: [0.5, 0.25, 4],
      offset: [300, -70, 9],
    };
    const asked: number[][] = [];
    let [others, between] = [0, 0];
    const other = setInterval(() => others++, 1);
    const batches = await all(
      new PointQuery(parts, {
        volume: {
          toBox: () => "crossing",
          contains: (x, y, z) => {
            asked.push([x, y, z]);
            // As slow as it takes for a slice to be longer than the thread may be had.
            for (const until = performance.now() + 0.004; performance.now() < until; );
            if (asked.length === count - 1) between = others;
            return asked.length % 3 === 0;
          },
        },
      }),
    );
    clearInterval(other);
    expect(asked).toEqual(
      Array.from({ length: count }, (_, point) => {
        const [x, y, z] = xyz.subarray(3 * point);
        return [300 + x / 2, y / 4 - 70, 9 + 4 * z];
      }),
    );
    expect(batches.map(({ inside }) => [...inside])).toEqual([
      Array.from({ length: Math.floor(count / 3) }, (_, third) => 3 * third + 2),
    ]);
    expect(between).toBeGreaterThanOrEqual(2);
  });

  it("hands out the same batches again, while another goes on", async () => {
    const volume = disc(400, 400, 300);
    const query = new PointQuery(partsOf(pagedOctree(7)).parts, { volume });
    const [one, other, { most, nodes }] = await Promise.all([all(query), all(query), query.bracket()]);
    const alone = new PointQuery(partsOf(pagedOctree(7)).parts, { volume });
    const names = (await all(alone)).map(({ node }) => node);
    expect(one.map(({ node }) => node)).toEqual(names);
    expect(other.map(({ node }) => node)).toEqual(names);
    expect({ most, nodes }).toEqual({ most: expect.any(Number), nodes: (await alone.bracket()).nodes });
    expect(total(one)).toBe(total(other));
    expect(total(one)).toBeGreaterThan(0);
    expect(most).toBeGreaterThanOrEqual(total(one));
  });

  it("fails as a whole where a node or a page fails, and may be asked again", async () => {
    const octree = pagedOctree(9);
    const { parts } = partsOf(octree);
    let broken = true;
    const failing: QueryParts = {
      ...parts,
      records: (node, signal) =>
        broken && node.key.depth === 3 ? Promise.reject(new Error("damaged")) : parts.records(node, signal),
    };
    const query = new PointQuery(failing, {});
    await expect(all(query)).rejects.toThrow("damaged");
    broken = false;
    expect(total(await all(query))).toBe(octree.points);
    let pages = 0;
    const hidden: QueryParts = {
      ...parts,
      withNode: (key, signal, work) =>
        key.depth === 2 && pages++ === 0
          ? Promise.reject(new Error("no page"))
          : parts.withNode(key, signal, work),
    };
    const other = new PointQuery(hidden, {});
    await expect(other.bracket()).rejects.toThrow("no page");
    expect((await other.bracket()).most).toBe(octree.points);
  });

  it("stops with the signal's reason", async () => {
    const { parts, asked } = partsOf(pagedOctree(5));
    const query = new PointQuery(parts, {});
    const control = new AbortController();
    const batches = query.batches({ signal: control.signal });
    await batches.next();
    control.abort(new Error("enough"));
    await expect(
      (async () => {
        for await (const _ of batches);
      })(),
    ).rejects.toThrow("enough");
    const { chunks } = asked;
    await expect(query.bracket({ signal: AbortSignal.abort(new Error("no")) })).rejects.toThrow("no");
    expect(asked.chunks).toBe(chunks);
  });

  it.each<[object, string]>([
    [{ spacing: Number.NaN }, "options.spacing cannot be NaN. Use a number from 0 on"],
    [{ spacing: -1 }, "options.spacing cannot be -1"],
    [{ spaceing: 1 }, 'options has no "spaceing". Did you mean "spacing"?'],
    [{ volume: { contains: () => true } }, "use an object with the methods toBox and contains"],
    [[0, 1], "options cannot be an array of 2"],
  ])("refuses %o at once", (options, message) => {
    const { parts } = partsOf(pagedOctree(1));
    expect(() => new PointQuery(parts, options)).toThrow(refusal(message));
  });

  it("refuses what is no signal before anything is read", async () => {
    const { parts, asked } = partsOf(pagedOctree(1));
    const query = new PointQuery(parts, {});
    const wrong = { signal: new AbortController() as never };
    await expect(query.bracket(wrong)).rejects.toThrow(refusal("options.signal cannot be an object"));
    expect(() => query.batches(wrong)).toThrow(refusal("options.signal cannot be an object"));
    expect(() => query.batches({ singal: AbortSignal.abort() } as never)).toThrow(
      refusal('did you mean "signal"'),
    );
    expect(asked).toEqual({ pages: 0, chunks: 0, atOnce: 0, most: 0 });
  });
});
