import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { type Demand, pointsAt, thresholdFor } from "./share.js";
import { SharedBudget } from "./shared-budget.js";

/** A chain of levels, each half as wide apart as the one before. */
const demand = (size: number, pixels: number): Demand => ({
  sizes: [size, 4 * size, 16 * size],
  pixels: [pixels, pixels / 2, pixels / 4],
  base: [true, false, false],
  caps: [1, 1, 1],
  prefix: true,
});
const sum = (counts: readonly number[]) => counts.reduce((total, count) => total + count, 0);

describe("SharedBudget", () => {
  it("leaves a view alone with it all that it wants", () => {
    const budget = new SharedBudget({ points: 1000 });
    const all = budget.grant({}, demand(10, 50), Number.POSITIVE_INFINITY);
    expect([sum(all.counts), all.threshold, budget.granted, budget.balanced]).toEqual([210, 0, 210, true]);
    const much = new SharedBudget({ points: 100 }).grant({}, demand(10, 50), Number.POSITIVE_INFINITY);
    expect(sum(much.counts)).toBe(100);
  });

  it("is never passed, whoever asks in whatever order, and comes to one spacing for all", () => {
    const asking = fc.array(
      fc.record({
        view: fc.nat(3),
        size: fc.integer({ min: 1, max: 5000 }),
        pixels: fc.integer({ min: 1, max: 99 }),
      }),
      { minLength: 1, maxLength: 20 },
    );
    fc.assert(
      fc.property(asking, fc.integer({ min: 0, max: 50_000 }), (asked, points) => {
        const budget = new SharedBudget({ points });
        const views = [{}, {}, {}, {}];
        const latest = new Map<number, Demand>();
        for (const { view, size, pixels } of asked) {
          latest.set(view, demand(size, pixels));
          budget.grant(views[view], demand(size, pixels), Number.POSITIVE_INFINITY);
          expect(budget.granted).toBeLessThanOrEqual(points);
        }
        // Two more frames in which nothing changes give each its part.
        for (let frame = 0; frame < 2; frame++) {
          for (const [view, wanted] of latest) budget.grant(views[view], wanted, Number.POSITIVE_INFINITY);
        }
        expect(budget.balanced).toBe(true);
        const wanted = [...latest.values()].reduce((total, of) => total + pointsAt(of, 0), 0);
        expect(budget.granted).toBeGreaterThanOrEqual(Math.min(wanted, points) - 4);
      }),
    );
  });

  it("gives most to the cloud that is nearest, as one octree would", () => {
    const budget = new SharedBudget({ points: 2000 });
    const [near, far] = [{}, {}];
    const ask = () => [
      budget.grant(near, demand(100, 40), Number.POSITIVE_INFINITY),
      budget.grant(far, demand(100, 10), Number.POSITIVE_INFINITY),
    ];
    ask();
    expect(budget.balanced).toBe(false);
    ask();
    const [first, second] = ask();
    expect(budget.balanced).toBe(true);
    expect(sum(first.counts)).toBeGreaterThan(3 * sum(second.counts));
    expect(first.threshold / second.threshold).toBeCloseTo(1, 2);
  });

  it("frees what a view had once that ends, and keeps a view's own limit", () => {
    const budget = new SharedBudget({ points: 1000 });
    const [one, two] = [{}, {}];
    expect(sum(budget.grant(one, demand(100, 40), 300).counts)).toBe(300);
    expect(budget.balanced).toBe(true);
    budget.grant(two, demand(100, 40), Number.POSITIVE_INFINITY);
    budget.release(one);
    budget.release(two);
    expect(budget.granted).toBe(0);
    expect(sum(budget.grant(two, demand(100, 40), Number.POSITIVE_INFINITY).counts)).toBe(1000);
  });

  it("refuses at once what is no budget, and keeps the one it has", () => {
    const code = (make: () => unknown) => {
      try {
        make();
        return "made";
      } catch (thrown) {
        return `${(thrown as { code?: string }).code}: ${(thrown as Error).message}`;
      }
    };
    for (const amount of [Number.NaN, -1, "1000", null, [5]]) {
      for (const name of ["points", "cpuBytes", "gpuBytes"]) {
        const told = code(() => new SharedBudget({ [name]: amount }));
        expect(told).toMatch(
          new RegExp(`^STYLE_OPTION: .*SharedBudget: options.${name} cannot be .* from 0 on`),
        );
      }
      const budget = new SharedBudget({ points: 7 });
      expect(code(() => Object.assign(budget, { points: amount }))).toMatch(
        /^STYLE_OPTION.* points cannot be /,
      );
      expect(budget.points).toBe(7);
    }
    expect(code(() => new SharedBudget({ pionts: 5 } as never))).toContain('Did you mean "points"');
    expect(code(() => new SharedBudget(5 as never))).toContain("Use an object with points");
    const [none, all] = [new SharedBudget({ points: 0 }), new SharedBudget({ points: undefined })];
    expect([none.points, all.points]).toEqual([0, 1_000_000]);
    none.points = Number.POSITIVE_INFINITY;
    expect(none.points).toBe(Number.POSITIVE_INFINITY);
  });

  it("has the limits that it is given, else those of its docs", () => {
    const { points, cpu, gpu } = new SharedBudget();
    expect([points, cpu.limit, gpu.limit]).toEqual([1_000_000, 268_435_456, 536_870_912]);
    const given = new SharedBudget({ points: 1, cpuBytes: 2, gpuBytes: 0 });
    expect([given.points, given.cpu.limit, given.gpu.limit]).toEqual([1, 2, 0]);
  });

  it("has a view with a limit of its own at the spacing that this limit allows", () => {
    const budget = new SharedBudget({ points: 1000 });
    const wanted = demand(100, 40);
    const { threshold, counts } = budget.grant({}, wanted, 300);
    expect(threshold).toBeCloseTo(thresholdFor([wanted], 300), 9);
    expect(pointsAt(wanted, threshold)).toBeGreaterThan(299);
    expect(sum(counts)).toBe(300);
  });

  it("stays in balance when a view leaves that had next to nothing", () => {
    const budget = new SharedBudget({ points: 2000 });
    const [one, two, little] = [{}, {}, {}];
    for (let frame = 0; frame < 3; frame++) {
      budget.grant(one, demand(100, 40), Number.POSITIVE_INFINITY);
      budget.grant(two, demand(100, 30), Number.POSITIVE_INFINITY);
      budget.grant(little, { ...demand(1, 1e-3), sizes: [1, 0, 0] }, Number.POSITIVE_INFINITY);
    }
    expect(budget.balanced).toBe(true);
    budget.release(little);
    expect(budget.balanced).toBe(true);
    budget.release(two);
    expect(budget.balanced).toBe(false);
    budget.grant(one, demand(100, 40), Number.POSITIVE_INFINITY);
    expect([budget.balanced, budget.granted]).toEqual([true, 2000]);
  });

  it("tells when a view has to ask again, and no more once each has its part", () => {
    const budget = new SharedBudget({ points: 1000 });
    const [one, two] = [{}, {}];
    let told = 0;
    const end = budget.onChange(() => told++);
    const ask = (view: object, wanted: number) => {
      const before = told;
      budget.grant(view, demand(wanted, 40), Number.POSITIVE_INFINITY);
      return told - before;
    };
    expect(ask(one, 100)).toBe(0);
    expect(ask(two, 100)).toBe(1);
    while (!budget.balanced) for (const view of [one, two]) ask(view, 100);
    expect([ask(one, 100), ask(two, 100)]).toEqual([0, 0]);
    budget.release(two);
    expect(told).toBeGreaterThan(1);
    const before = told;
    budget.points = 500;
    expect(told).toBe(before + 1);
    end();
    budget.points = 700;
    expect(told).toBe(before + 1);
  });

  it("adds up bytes by owner, and asks for some back beyond the limit", () => {
    const { gpu } = new SharedBudget({ gpuBytes: 100 });
    const [one, two] = [{}, {}];
    gpu.report(one, 70);
    gpu.report(two, 30);
    expect([gpu.used, gpu.excess]).toEqual([100, 0]);
    gpu.report(two, 40);
    expect([gpu.used, gpu.excess]).toEqual([110, 30]);
    gpu.report(one, 0);
    expect([gpu.used, gpu.excess]).toEqual([40, 0]);
  });
});
