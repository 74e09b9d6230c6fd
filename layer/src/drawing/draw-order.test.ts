import fc from "fast-check";
import { expect, it } from "vitest";
import { DrawOrder } from "./draw-order.js";

const node = (page: number, nearest: number) => ({ uploaded: { page }, nearest });
type Node = ReturnType<typeof node>;

const ordered = (order: DrawOrder, nodes: readonly Node[]) =>
  order.of(
    nodes,
    nodes.map(({ nearest }) => nearest),
  );

it("draws pages one after the other, the nearest first, and their nodes from near to far", () => {
  const nodes = [node(2, 40), node(0, 500), node(2, 3), node(1, 10), node(0, 20), node(1, 0.1)];
  const order = new DrawOrder();
  expect(ordered(order, nodes)).toEqual([nodes[5], nodes[3], nodes[2], nodes[0], nodes[4], nodes[1]]);
  // Without distances, as they come.
  expect(order.of(nodes, undefined)).toEqual([nodes[0], nodes[2], nodes[1], nodes[4], nodes[3], nodes[5]]);
  expect(order.of([], [])).toEqual([]);
});

it("has each node once, those of a page together, and from near to far but for steps of a thousandth of the range", () => {
  const order = new DrawOrder();
  const distance = fc.double({ min: -3, max: 7, noNaN: true }).map((exponent) => 10 ** exponent);
  const some = fc.array(fc.tuple(fc.integer({ min: 0, max: 5 }), distance), { maxLength: 200 });
  fc.assert(
    fc.property(some, (given) => {
      const nodes = given.map(([page, nearest]) => node(page, nearest));
      const drawn = ordered(order, nodes);
      expect(new Set(drawn)).toEqual(new Set(nodes));
      expect(drawn.length).toBe(nodes.length);
      const pages = drawn
        .map(({ uploaded }) => uploaded.page)
        .filter((page, at, all) => page !== all[at - 1]);
      expect(pages).toEqual([...new Set(pages)]);
      const distances = drawn.map(({ nearest }) => Math.log2(nearest));
      const range = Math.max(...distances) - Math.min(...distances);
      for (const [at, { uploaded }] of drawn.entries()) {
        if (uploaded.page !== drawn[at - 1]?.uploaded.page) continue;
        // A step of the bits of a float is no more than 1.5 times as wide in the logarithm as in the mean.
        expect(distances[at - 1]).toBeLessThanOrEqual(distances[at]! + (3 * (range + 1)) / 1024);
      }
    }),
  );
});
