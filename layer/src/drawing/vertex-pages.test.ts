import fc from "fast-check";
import { describe, expect, it } from "vitest";
import type { Column } from "../workers/index.js";
import { attributeSet } from "./vertex-attributes.js";
import { type PagePositions, type PageSlot, type PageTenant, VertexPages } from "./vertex-pages.js";
import { TestGpu, TestNode, type TestTypes } from "./view.fixture.js";

const read = (column: string, location: number, components: 1 | 3 | 4 = 1) => ({
  ...{ name: `a_${column}`, column, location, components, normalized: false },
});
const PLAIN = attributeSet([read("position", 0, 3)]);
const CLASSES = attributeSet([read("position", 0, 3), read("classification", 1)]);

class Tenant implements PageTenant {
  slot: PageSlot<TestTypes> | undefined;
  readonly #pages: VertexPages<TestTypes>;
  readonly #positions: PagePositions;

  constructor(pages: VertexPages<TestTypes>, positions: PagePositions = "float32") {
    this.#pages = pages;
    this.#positions = positions;
  }

  take(count: number): void {
    this.slot = this.#pages.reserve(count, this, this.#positions);
  }

  move(to: PageSlot<TestTypes>): void {
    this.leave();
    this.slot = to;
  }

  leave(): void {
    if (this.slot) this.#pages.release(this.slot);
    this.slot = undefined;
  }
}

/** Vertices of a page that are given out; throws where one has two tenants. */
function taken(tenants: readonly Tenant[]) {
  const pages = new Map<object, [number, number][]>();
  for (const { slot } of tenants) {
    if (!slot) continue;
    const runs = pages.get(slot.page) ?? [];
    runs.push([slot.first, slot.first + slot.count]);
    pages.set(slot.page, runs);
  }
  for (const runs of pages.values()) {
    runs.sort(([a], [b]) => a - b);
    runs.forEach(([first], at) => {
      if (at > 0 && runs[at - 1]![1] > first) throw new Error(`vertex ${first} has two tenants`);
    });
  }
  return pages;
}

describe("VertexPages", () => {
  it("gives each node vertices of its own, and never takes much more room than there are, whatever comes and goes", () => {
    const steps = fc.array(fc.tuple(fc.nat(40), fc.integer({ min: 1, max: 60_000 })), { maxLength: 200 });
    fc.assert(
      fc.property(steps, (changes) => {
        const pages = new VertexPages<TestTypes>(new TestGpu());
        const tenants = Array.from(
          { length: 41 },
          (_, index) => new Tenant(pages, index % 3 === 0 ? "float32" : "uint16"),
        );
        for (const [which, count] of changes) {
          const tenant = tenants[which]!;
          if (tenant.slot) tenant.leave();
          else tenant.take(count);
        }
        const sum = (of: "used" | "capacity") => pages.pages.reduce((all, page) => all + page[of], 0);
        // Each makes one page of two.
        for (let frame = 0; frame < 60; frame++) pages.tidy();
        expect(taken(tenants).size).toBe(pages.pages.length);
        const wanted = tenants.reduce((all, { slot }) => all + (slot?.count ?? 0), 0);
        expect(sum("used")).toBe(wanted);
        // Each kind has a page that may be far from full.
        const most = (["float32", "uint16"] as const).map((kind) =>
          pages.pages.reduce((all, page) => Math.max(all, page.positions === kind ? page.capacity : 0), 0),
        );
        expect(sum("capacity")).toBeLessThanOrEqual(2 * wanted + most[0]! + most[1]!);
        for (const { slot } of tenants.filter((_, index) => index % 3 === 0)) {
          if (slot) expect(slot.page.positions).toBe("float32");
        }
        for (const tenant of tenants) tenant.leave();
        expect(pages.pages).toEqual([]);
      }),
    );
  });

  it("uses vertices again that were given back, so that coming and going makes no further pages", () => {
    const pages = new VertexPages<TestTypes>(new TestGpu());
    const tenants = Array.from({ length: 40 }, () => new Tenant(pages));
    for (const tenant of tenants) tenant.take(10_000);
    const before = pages.pages.length;
    expect(before).toBeLessThan(10);
    for (let round = 0; round < 100; round++) {
      const tenant = tenants[(round * 7) % 40]!;
      tenant.leave();
      tenant.take(9000 + (round % 1000));
      pages.tidy();
    }
    expect(pages.pages.length).toBeLessThanOrEqual(before);
  });
});

describe("nodes in pages", () => {
  const node = (
    pages: VertexPages<TestTypes>,
    count: number,
    columns: readonly Column[] = [],
    step?: number,
  ) =>
    new TestNode(
      pages,
      {
        ...{ positions: new Float32Array(3 * count).fill(count), count, step },
        columns: new Map(columns.map((column) => [column.name, column])),
      } as unknown as ConstructorParameters<typeof TestNode>[1],
      0,
    );
  const classes = (count: number, constant?: number): Column => ({
    ...{ name: "classification", components: 1, scale: 1, offset: 0, bound: 0 },
    data: new Uint16Array(constant === undefined ? count : 0).fill(700),
    ...(constant !== undefined && { constant: [constant] }),
  });

  it("are read through one vertex array, those too whose points share a value", () => {
    const gpu = new TestGpu();
    const pages = new VertexPages<TestTypes>(gpu);
    const nodes = [
      node(pages, 10, [classes(10)]),
      node(pages, 20, [classes(20, 2)]),
      node(pages, 5, [classes(5, 65_535)]),
    ];
    expect(new Set(nodes.map((each) => each.arrayOf(CLASSES))).size).toBe(1);
    expect(nodes.map(({ first }) => first)).toEqual([0, 10, 30]);
    const [, column] = gpu.buffers();
    expect([...column!.written(Uint16Array, 0, 35)]).toEqual([
      ...new Array(10).fill(700),
      ...new Array(20).fill(2),
      ...new Array(5).fill(65_535),
    ]);
    // No 16 bits say it.
    const other = node(pages, 5, [classes(5, -0.5)]);
    expect(other.arrayOf(CLASSES)).not.toBe(nodes[0]!.arrayOf(CLASSES));
    expect(other.page).toBe(nodes[0]!.page);
  });

  it("take 8 bytes for positions at whole steps and 12 for others, in pages of their own", () => {
    const gpu = new TestGpu();
    const pages = new VertexPages<TestTypes>(gpu);
    const nodes = [0.5, undefined, 0.25].map((step) => node(pages, 10, [], step));
    const arrays = nodes.map((each) => each.arrayOf(PLAIN));
    expect(nodes.map(({ bytes }) => bytes)).toEqual([80, 120, 80]);
    expect(arrays[2]).toBe(arrays[0]);
    expect(arrays[1]).not.toBe(arrays[0]);
    const [steps] = gpu.buffersOf(arrays[0]!);
    // 10 m in half metres, then in quarters.
    expect([...steps!.written(Uint16Array, 36, 8)]).toEqual([20, 20, 20, 0, 40, 40, 40, 0]);
    expect(steps!.sizeInBytes).toBe(8 * pages.pages[0]!.capacity);
  });

  it("have no buffer for what the data set has not", () => {
    const gpu = new TestGpu();
    node(new VertexPages<TestTypes>(gpu), 10).upload(CLASSES);
    expect(gpu.counts.buffers).toBe(1);
  });

  it("are what they were when their page is given up, and free it with all that is in it", () => {
    const gpu = new TestGpu();
    const pages = new VertexPages<TestTypes>(gpu);
    const nodes = Array.from({ length: 12 }, (_, index) => {
      const made = node(pages, 4000 + index, [classes(4000 + index)]);
      for (const set of [PLAIN, CLASSES]) made.upload(set);
      return made;
    });
    const before = pages.pages.length;
    const kept = nodes.filter((_, index) => index % 4 === 0);
    for (const each of nodes) if (!kept.includes(each)) each.destroy();
    for (let frame = 0; frame < 10; frame++) pages.tidy();
    expect(pages.pages.length).toBeLessThan(before);
    for (const each of kept) {
      const { first, vertices } = each;
      expect([each.has(PLAIN), each.has(CLASSES)]).toEqual([true, true]);
      const [positions] = gpu.buffersOf(each.arrayOf(CLASSES));
      expect([...positions!.written(Float32Array, 3 * first, 3)]).toEqual([
        ...vertices.positions.slice(0, 3),
      ]);
    }
    for (const each of kept) each.keep([PLAIN]);
    expect(gpu.counts.buffers).toBe(pages.pages.length);
    for (const each of kept) each.destroy();
    expect(Object.values(gpu.counts).every((count) => count === 0)).toBe(true);
  });
});
