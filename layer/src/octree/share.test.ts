import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { countsAt, type Demand, pointsAt, shareOf, thresholdFor } from "./share.js";

/** Nodes in falling order of their pixels, as a traversal gathers them. */
const demands: fc.Arbitrary<Demand> = fc
  .record({
    nodes: fc.array(
      fc.record({
        size: fc.integer({ min: 1, max: 100_000 }),
        pixels: fc.double({ min: 0.5, max: 500, noNaN: true }),
      }),
      { minLength: 1, maxLength: 60 },
    ),
    prefix: fc.boolean(),
  })
  .map(({ nodes, prefix }) => {
    const pixels = nodes.map((node) => node.pixels).sort((a, b) => b - a);
    const base = pixels.map((_, index) => index === 0);
    const caps = pixels.map((value, index) => (prefix ? shareOf(value, 2, base[index]) : 1));
    return { sizes: nodes.map(({ size }) => size), pixels, base, caps, prefix };
  });

const sum = (counts: readonly number[]) => counts.reduce((total, count) => total + count, 0);

describe("shareOf", () => {
  it("brings every spacing to one density", () => {
    const pixels = fc.double({ min: 0.5, max: 1, noNaN: true });
    fc.assert(
      fc.property(pixels, (p) => {
        // Threshold 1: a node with all above it, and its parents alone.
        const whole = 1 / p ** 2;
        const parents = whole / 4;
        expect(parents + shareOf(p, 1, false) * (whole - parents)).toBeCloseTo(1, 9);
        expect(shareOf(p, 1, true) * whole).toBeCloseTo(1, 9);
      }),
    );
  });

  it("begins at half the threshold and is whole at it", () => {
    expect([0.4, 0.5, 1, 7].map((pixels) => shareOf(pixels, 1, false))).toEqual([0, 0, 1, 1]);
  });
});

describe("countsAt", () => {
  /** Nodes of 100 points each, the first with nothing above it. */
  const some = (prefix: boolean, ...pixels: readonly number[]): Demand => ({
    ...{ pixels: [...pixels], prefix, sizes: pixels.map(() => 100), caps: pixels.map(() => 1) },
    base: pixels.map((_, index) => index === 0),
  });

  it("draws nodes whole or not at all where they have no order: those more than half the threshold wide", () => {
    const pixels = fc.array(fc.double({ min: 0.5, max: 100, noNaN: true }), { minLength: 1, maxLength: 20 });
    const limits = fc.integer({ min: 0, max: 2500 });
    fc.assert(
      fc.property(pixels, fc.double({ min: 0.5, max: 200, noNaN: true }), limits, (all, threshold, limit) => {
        const falling = all.sort((a, b) => b - a);
        const wide = falling.filter((p) => 2 * p > threshold).length;
        const demand = some(false, ...falling);
        expect(pointsAt(demand, threshold)).toBe(100 * wide);
        const counts = countsAt(demand, threshold * (1 + 1e-5), limit);
        const fit = Math.min(falling.filter((p) => 2 * p > threshold * (1 + 1e-5)).length, limit / 100);
        expect(counts).toEqual(falling.map((_, index) => (index < Math.floor(fit) ? 100 : 0)));
      }),
    );
  });

  it("gives what is left to nodes drawn in part, as long as they have points, and to no other", () => {
    // 6.25 of the first, 8.3 of the second, none of the third; then what is left in turns.
    const demand = some(true, 1, 2.236, 1.9);
    expect(countsAt(demand, 4, 14)).toEqual([6, 8, 0]);
    expect(countsAt(demand, 4, 15)).toEqual([7, 8, 0]);
    expect(countsAt(demand, 4, 16)).toEqual([7, 9, 0]);
    expect(countsAt(demand, 4, 54)).toEqual([26, 28, 0]);
    expect(countsAt(demand, 4, 1000)).toEqual([100, 100, 0]);
  });

  it("shows a part that nothing is above by one point, and rounds the others", () => {
    const demand: Demand = { ...some(true, 9, 8, 7, 6, 5), caps: [0.001, 0.001, 0.006, 0.996, 0.994] };
    expect(countsAt(demand, 0, 1e9)).toEqual([1, 0, 1, 100, 99]);
    expect(countsAt({ ...demand, sizes: [0, 0, 0, 0, 0] }, 0, 1e9)).toEqual([0, 0, 0, 0, 0]);
    // Where a budget limits, it is at the threshold alone.
    expect(countsAt(some(true, 0.1, 0.05), 4, 0)).toEqual([0, 0]);
    const partly = { ...some(true, 0.1, 0.05), base: [true, true] };
    expect(countsAt(partly, 4, 1)).toEqual([1, 0]);
  });

  it("has no points beyond the limit", () => {
    expect(countsAt(some(true, 9, 8, 7), 0, 150.7)).toEqual([100, 50, 0]);
    expect(countsAt(some(false, 9, 8, 7), 0, 200)).toEqual([100, 100, 0]);
    expect(countsAt(some(true, 9), 0, -5)).toEqual([0]);
  });
});

describe("thresholdFor", () => {
  it("spends a limit to the last point and never more, where it is what limits", () => {
    fc.assert(
      fc.property(demands, fc.integer({ min: 0, max: 2_000_000 }), (demand, limit) => {
        const threshold = thresholdFor([demand], limit);
        const counts = countsAt(demand, threshold, limit);
        expect(sum(counts)).toBeLessThanOrEqual(limit);
        expect(counts.every((count, index) => count >= 0 && count <= demand.sizes[index])).toBe(true);
        if (threshold === 0) {
          expect(Math.abs(sum(counts) - pointsAt(demand, 0))).toBeLessThanOrEqual(demand.sizes.length);
        } else if (demand.prefix && counts[0] > 0) expect(sum(counts)).toBe(limit);
        // The next smaller spacing would be too much.
        if (threshold > 0 && demand.prefix) {
          expect(pointsAt(demand, threshold * (1 - 1e-6))).toBeGreaterThan(limit - 1);
        }
      }),
    );
  });

  it("comes to an end whatever the numbers", () => {
    const pixels = [Number.POSITIVE_INFINITY, 1e300, 1e-300, Number.NaN];
    for (const prefix of [true, false]) {
      const [caps, base] = [pixels.map(() => 1), pixels.map((_, index) => index === 0)];
      const demand = { sizes: pixels.map(() => 1000), pixels, caps, base, prefix };
      const counts = countsAt(demand, thresholdFor([demand], 500), 500);
      expect(sum(counts.filter(Number.isFinite))).toBeLessThanOrEqual(500);
    }
  });

  it("is one for several demands together", () => {
    fc.assert(
      fc.property(demands, demands, (a, b) => {
        const limit = (pointsAt(a, 0) + pointsAt(b, 0)) / 3;
        const threshold = thresholdFor([a, b], limit);
        expect(pointsAt(a, threshold) + pointsAt(b, threshold)).toBeLessThanOrEqual(limit * (1 + 1e-9));
      }),
    );
  });
});
