import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { drawingOrder } from "./drawing-order.js";
import { cellGrid, mortonSort } from "./morton-sort.js";
import { randomNumbers } from "./record.fixture.js";

const EDGE = 100_000;
const grid = cellGrid([0, 0, 0, EDGE], [1, 1, 1], [0, 0, 0]);

/** A hilly surface with a wall on it, scanned line by line: 3 · count integers in the cube. */
function scan(count: number, seed: number): Int32Array {
  const next = randomNumbers(seed);
  const side = Math.ceil(Math.sqrt(count));
  const xyz = new Int32Array(3 * count);
  for (let point = 0; point < count; point++) {
    const x = ((point % side) + next()) / side;
    const y = (Math.floor(point / side) + next()) / side;
    const wall = x > 0.4 && x < 0.42 ? next() * 0.3 : 0;
    xyz.set(
      [x, y, 0.3 + 0.1 * Math.sin(7 * x) * Math.cos(5 * y) + wall].map((v) => Math.floor(v * EDGE)),
      3 * point,
    );
  }
  return xyz;
}

/** Root mean square and greatest distance of the points from the nearest one among the first `share` in an order. */
function coverage(xyz: Int32Array, order: ArrayLike<number>, share: number) {
  const count = xyz.length / 3;
  const drawn = Math.round(share * count);
  let square = 0;
  let greatest = 0;
  let probes = 0;
  for (let probe = 0; probe < count; probe += 7, probes++) {
    let least = Number.POSITIVE_INFINITY;
    for (let i = 0; i < drawn; i++) {
      const at = 3 * order[i];
      const dx = xyz[at] - xyz[3 * probe];
      const dy = xyz[at + 1] - xyz[3 * probe + 1];
      const dz = xyz[at + 2] - xyz[3 * probe + 2];
      least = Math.min(least, dx * dx + dy * dy + dz * dz);
    }
    square += least;
    greatest = Math.max(greatest, least);
  }
  return { rms: Math.sqrt(square / probes), worst: Math.sqrt(greatest) };
}

function shuffled(count: number, seed: number): Uint32Array {
  const next = randomNumbers(seed);
  const order = Uint32Array.from({ length: count }, (_, index) => index);
  for (let i = count - 1; i > 0; i--) {
    const j = Math.floor(next() * (i + 1));
    [order[i], order[j]] = [order[j], order[i]];
  }
  return order;
}

describe("drawingOrder", () => {
  it("names each record once, whatever the points are", () => {
    const integer = fc.oneof(fc.integer({ min: -50, max: EDGE + 50 }), fc.constant(7));
    fc.assert(
      fc.property(fc.array(fc.tuple(integer, integer, integer), { maxLength: 300 }), (points) => {
        const order = drawingOrder(Int32Array.from(points.flat()), points.length, grid);
        expect([...order].sort((a, b) => a - b)).toEqual(points.map((_, index) => index));
      }),
    );
  });

  it("begins with one point of each cell that is taken, level by level", () => {
    const xyz = scan(5000, 4);
    const order = drawingOrder(xyz, 5000, grid);
    for (const cells of [2, 4, 8, 16]) {
      const cellOf = (point: number) =>
        [0, 1, 2].map((axis) => Math.floor((xyz[3 * point + axis] * cells) / EDGE)).join();
      const taken = new Set(Array.from({ length: 5000 }, (_, point) => cellOf(point))).size;
      expect(new Set([...order.subarray(0, taken)].map(cellOf)).size).toBe(taken);
    }
  });

  it.each([0.02, 0.1, 0.3])(
    "covers a node with a share of %f of it better than chance or records do",
    (share) => {
      const xyz = scan(6000, 9);
      const even = coverage(xyz, drawingOrder(xyz, 6000, grid), share);
      const chance = coverage(xyz, shuffled(6000, 3), share);
      const recorded = coverage(
        xyz,
        shuffled(6000, 3).map((_, index) => index),
        share,
      );
      expect(even.rms).toBeLessThan(chance.rms);
      expect(even.worst).toBeLessThan(0.8 * chance.worst);
      expect(even.rms).toBeLessThan(recorded.rms / 4);
    },
  );

  it("counts in 16 bits as long as they suffice", () => {
    const many = 65537;
    const xyz = Int32Array.from({ length: 3 * many }, (_, i) => i % EDGE);
    expect(drawingOrder(xyz, 65536, grid)).toBeInstanceOf(Uint16Array);
    const order = drawingOrder(xyz, many, grid);
    expect(order).toBeInstanceOf(Uint32Array);
    expect(order).toContain(65536);
  });

  it("stands a cube without extent", () => {
    const flat = cellGrid([5, 5, 5, 0], [1, 1, 1], [0, 0, 0]);
    expect([...drawingOrder(Int32Array.of(5, 5, 5, 5, 5, 5), 2, flat)].sort()).toEqual([0, 1]);
  });
});

describe("mortonSort", () => {
  it("sorts by codes, and equal codes by record", () => {
    const xyz = scan(3000, 1);
    const { indices, codes } = mortonSort(xyz, 3000, grid);
    for (let rank = 1; rank < 3000; rank++) {
      expect(codes[rank]).toBeGreaterThanOrEqual(codes[rank - 1]);
      if (codes[rank] === codes[rank - 1]) expect(indices[rank]).toBeGreaterThan(indices[rank - 1]);
    }
  });
});
