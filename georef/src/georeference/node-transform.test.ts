import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { AMPLIFICATION } from "../approximation/chebyshev.js";
import { random } from "../cartesian/points.fixture.js";
import { compileTransformation, type Domain, fitPatchwork, type Step, WGS84 } from "../index.js";
import { samplerOf } from "../transformation/sampler.fixture.js";
import { AREA, chanceSteps, patchwork } from "./chance-grids.fixture.js";
import { addRemainder } from "./grid-remainder.js";
import { type NodeTransform, nodeTransform } from "./node-transform.js";

/** Places in a node: u, v and w from −1 to 1, the corners first. */
function places(count: number, seed: number): number[][] {
  const next = random(seed);
  return Array.from({ length: count }, (_, i) =>
    [0, 1, 2].map((axis) => (i < 8 ? ((i >> axis) & 1 ? 1 : -1) : 2 * next() - 1)),
  );
}

/** By correction: the greatest distance of smooth part and correction from the truth, and the greatest correction. */
function measured(
  { smooth, corrections, truth }: NodeTransform,
  domain: Domain,
  count: number,
  seed: number,
) {
  const found = corrections.map(() => ({ off: 0, added: 0 }));
  const { minX, minY, minZ, maxX, maxY, maxZ } = domain;
  const [parts, want] = [new Float64Array(6), new Float64Array(3)];
  const between = (least: number, greatest: number, t: number) => least + ((greatest - least) * (t + 1)) / 2;
  for (const [u, v, w] of places(count, seed)) {
    const [x, y, z] = [between(minX, maxX, u), between(minY, maxY, v), between(minZ, maxZ, w)];
    smooth(x, y, parts, 0);
    truth(x, y, z, want, 0);
    for (const [k, { remainders }] of corrections.entries()) {
      const sum = new Float64Array(3);
      for (const remainder of remainders) addRemainder(remainder, u, v, sum);
      const off = [0, 1, 2].map((axis) => parts[axis] + z * parts[axis + 3] + sum[axis] - want[axis]);
      found[k].off = Math.max(found[k].off, Math.hypot(...off));
      found[k].added = Math.max(found[k].added, Math.hypot(...sum));
    }
  }
  return found;
}

const share = fc.noBias(fc.integer({ min: 0, max: 1e6 })).map((i) => i / 1e6);
const nodes = fc.record({
  at: fc.tuple(share, share),
  /** Decimal logarithm of the edge, 10 m to 3 km. */
  size: share.map((t) => 1 + 2.48 * t),
  height: share.map((t) => 3000 * t),
  /** Metres that neighbouring nodes of the grid differ by, from a tenth of a millimetre to 0.3 m. */
  roughness: share.map((t) => 10 ** (-4 + 3.5 * t)),
  grids: fc.constantFrom(
    { heights: true },
    ...(["forward", "inverse"] as const).flatMap((shift) => [
      { shift, heights: false },
      { shift, heights: true },
    ]),
  ),
  seed: fc.integer({ min: 1, max: 1e6 }),
});

describe("a transformation over a node, taken apart", () => {
  it("is within its bounds, whatever is added, and these are no wider than that takes", () => {
    let [wide, both] = [0, 0];
    fc.assert(
      fc.property(nodes, ({ at, size, height, roughness, grids, seed }) => {
        const edge = 10 ** size;
        const minX = AREA.minX + at[0] * (AREA.maxX - AREA.minX - edge);
        const minY = AREA.minY + at[1] * (AREA.maxY - AREA.minY - edge);
        const domain: Domain = { minX, minY, minZ: 0, maxX: minX + edge, maxY: minY + edge, maxZ: height };
        const steps = chanceSteps(roughness, seed, grids);
        const parts = nodeTransform(compileTransformation({ steps }), domain);
        const { corrections, truthBound } = parts;
        expect(truthBound).toBe(patchwork.bound);
        expect(corrections.map(({ remainders }) => remainders.length)).toEqual([...steps.slice(1).keys()]);
        // A node that hardly reaches into a cell knows its folds all the same.
        const little = 1e-3 * roughness + 1e-7;
        const found = measured(parts, domain, 1000, seed);
        for (const [k, { reach, bound }] of corrections.entries()) {
          const { off, added } = found[k];
          expect(off).toBeLessThanOrEqual(bound - truthBound + 1e-8);
          expect(added).toBeLessThanOrEqual(reach + 1e-12);
          // 1,000 places find a third of the greatest correction at least, among grids that are added up.
          expect(reach).toBeLessThanOrEqual(3.5 * added + little);
        }
        const [none, all] = [corrections[0], corrections[corrections.length - 1]];
        expect(corrections[0].reach).toBe(0);
        // Left out is what would be added; and of all that is added a hundredth may be wrong.
        expect(none.bound - truthBound).toBeGreaterThanOrEqual(all.reach - 1e-12);
        expect(none.bound - truthBound).toBeLessThanOrEqual(1.01 * all.reach + little);
        expect(all.bound - truthBound).toBeLessThanOrEqual(0.012 * all.reach + little);
        if (all.reach > 1e-4) wide++;
        if (corrections.length === 3) {
          // The greatest first.
          const [first, second] = [corrections[1].reach, corrections[2].reach - corrections[1].reach];
          expect(first).toBeGreaterThanOrEqual(second);
          // Nothing is left to add within one cell of its grid; `both` counts the nodes where much is.
          expect(second).toBeGreaterThanOrEqual(0);
          expect(corrections[1].bound - truthBound).toBeLessThanOrEqual(
            1.01 * second + 0.012 * first + little,
          );
          if (second > 1e-4) both++;
        }
      }),
      { numRuns: 150 },
    );
    expect(wide).toBeGreaterThan(20);
    expect(both).toBeGreaterThan(5);
  });

  it("has nothing left over within one cell of its grids", () => {
    // Cells are 1290 m × 1850 m: this one lies in the middle of one.
    const domain: Domain = { minX: 499e3, minY: 5093e3, minZ: 0, maxX: 499.3e3, maxY: 5093.3e3, maxZ: 900 };
    const steps = chanceSteps(0.5, 3, { shift: "forward", heights: true });
    const { corrections, truthBound } = nodeTransform(compileTransformation({ steps }), domain);
    for (const { reach, bound } of corrections) {
      expect(reach).toBeLessThan(1e-8);
      expect(bound).toBeCloseTo(truthBound, 8);
    }
  });

  it("has no bound for what is added where that moves points by more than its cells have room for", () => {
    const domain: Domain = { minX: 497e3, minY: 5089e3, minZ: 0, maxX: 500e3, maxY: 5092e3, maxZ: 100 };
    const boundsOf = (roughness: number) =>
      nodeTransform(
        compileTransformation({ steps: chanceSteps(roughness, 3, { shift: "inverse", heights: false }) }),
        domain,
      ).corrections.map(({ bound }) => bound);
    // 2 thousandths of a cell are 2.6 m from west to east.
    expect(boundsOf(0.3).every(Number.isFinite)).toBe(true);
    const [none, all] = boundsOf(9);
    expect(none).toBeLessThan(30);
    expect(all).toBe(Number.POSITIVE_INFINITY);
  });

  it("is not taken apart beside cells without data, and then as good as straight lines through three heights", () => {
    const domain: Domain = { minX: 499e3, minY: 5090e3, minZ: 0, maxX: 500e3, maxY: 5091e3, maxZ: 500 };
    const steps = chanceSteps(0.01, 3, { heights: true });
    const split = nodeTransform(compileTransformation({ steps }), domain);
    expect(split.corrections).toHaveLength(2);
    const holes = steps.map((step): Step => {
      if (step.kind !== "verticalShift") return step;
      const values = step.window.values.map((value, i) => (i % 2 === 0 ? Number.NaN : value));
      return { ...step, window: { ...step.window, values } };
    });
    const whole = nodeTransform(compileTransformation({ steps: holes }), domain);
    expect(whole.corrections).toEqual([]);
    expect(whole.truthBound).toBe(patchwork.bound);
  });

  it("goes to all places at once where there is no grid, whatever their height", () => {
    const steps: Step[] = [
      { kind: "projection", patchwork },
      { kind: "geocentric", ellipsoid: WGS84 },
    ];
    for (const [minZ, maxZ] of [
      [0, 3000],
      [-400, 8000],
      [500, 500],
    ]) {
      const domain: Domain = { minX: 496e3, minY: 5086e3, minZ, maxX: 502e3, maxY: 5094e3, maxZ };
      const parts = nodeTransform(compileTransformation({ steps }), domain);
      expect(parts.corrections).toEqual([
        { remainders: [], reach: 0, bound: expect.closeTo(parts.truthBound, 8) },
      ]);
      const [{ off }] = measured(parts, domain, 100, 1);
      expect(off).toBeLessThan(2e-8);
    }
  });

  it("counts the steps between patches where a node lies on several", async () => {
    const { minX, minY, maxX, maxY } = AREA;
    const halves = await Promise.all(
      [
        { ...AREA, maxX: 499e3 },
        { ...AREA, minX: 499e3 },
      ].map((half) => fitPatchwork(samplerOf("+proj=utm +zone=32 +ellps=WGS84"), half)),
    );
    const patches = halves.flatMap((half) => half.patches);
    const bound = Math.max(...halves.map((half) => half.bound));
    const wide = { ...halves[0], patches, bound };
    const steps: Step[] = [
      { kind: "projection", patchwork: wide },
      { kind: "geocentric", ellipsoid: WGS84 },
    ];
    const compiled = compileTransformation({ steps });
    const boundOver = (minX: number, minY: number, maxX: number, maxY: number) =>
      nodeTransform(compiled, { minX, minY, minZ: 0, maxX, maxY, maxZ: 10 }).corrections[0].bound;
    expect(boundOver(minX, minY, 499e3, maxY)).toBeCloseTo(bound, 8);
    expect(boundOver(499e3, minY, maxX, maxY)).toBeCloseTo(bound, 8);
    const several = (1 + AMPLIFICATION) * bound;
    expect(several).toBeGreaterThan(5 * bound);
    expect(boundOver(498.9e3, 5090e3, 499.1e3, 5090.2e3)).toBeCloseTo(several, 8);
    expect(boundOver(minX, minY, maxX, maxY)).toBeCloseTo(several, 8);
  });
});
