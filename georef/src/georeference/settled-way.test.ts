import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { distance, random } from "../cartesian/points.fixture.js";
import {
  compileTransformation,
  type Domain,
  ecefToGeodetic,
  fitPlacement,
  PlacementError,
  placeIntegers,
  type ShiftStep,
  type Transformation,
  type Way,
  WGS84,
  withHeights,
} from "../index.js";
import { AREA, chanceWindow, patchwork } from "./chance-grids.fixture.js";

const ALL = { minX: 0, minY: 0, maxX: 1e7, maxY: 1e7 };
const axes = { a: WGS84.a, f: WGS84.f };

/** Northing between the other two ways. */
const BORDER = 5_090_000;

/** A grid of shifts that covers the west of the area alone. */
function inner(seed: number): ShiftStep {
  const { values, ...window } = chanceWindow(2, 1, 0.05 / 6.4e6, seed);
  const columns = 8;
  const kept = Array.from(values).filter((_, i) => i % window.columns < columns);
  return {
    ...{ kind: "horizontalShift", direction: "inverse" },
    window: { ...window, columns, values: Float32Array.from(kept) },
  };
}

const moved = (translation: readonly [number, number, number]): ShiftStep => ({
  ...{ kind: "datumShift", from: axes, to: axes, translation },
  ...{ matrix: [1, 0, 0, 0, 1, 0, 0, 0, 1], keepHeight: true },
});

/** A grid in the west, a shift of its own north of a parallel, and another one wherever neither is. */
function chosen(seed: number): Transformation {
  const ways: Way[] = [
    { area: ALL, steps: [inner(seed)] },
    { area: { ...ALL, minY: BORDER }, steps: [moved([2, -1, 3])] },
    { area: ALL, steps: [moved([5, 5, 5])] },
  ];
  return {
    steps: [
      { kind: "projection", patchwork },
      { kind: "choice", ways },
      { kind: "geocentric", ellipsoid: axes },
    ],
  };
}

const along = (steps: readonly ShiftStep[]) =>
  compileTransformation({
    steps: [{ kind: "projection", patchwork }, ...steps, { kind: "geocentric", ellipsoid: axes }],
  });

const share = fc.noBias(fc.integer({ min: 0, max: 1e6 })).map((i) => i / 1e6);

describe("a choice between ways", () => {
  const seed = 7;
  const whole = compileTransformation(chosen(seed));
  const ways = [[inner(seed)], [moved([2, -1, 3])], [moved([5, 5, 5])]].map(along);

  it("takes each point the first way that is for its place and has one for it", () => {
    const met = [0, 0, 0];
    const [want, got] = [0, 0].map(() => new Float64Array(3));
    fc.assert(
      fc.property(share, share, share, (u, v, w) => {
        const [x, y, z] = [
          AREA.minX + u * (AREA.maxX - AREA.minX),
          AREA.minY + v * (AREA.maxY - AREA.minY),
          3000 * w,
        ];
        ways[0].evaluate(x, y, z, want, 0);
        const way = Number.isFinite(want[0]) ? 0 : y >= BORDER ? 1 : 2;
        met[way]++;
        ways[way].forward(x, y, z, want);
        whole.forward(x, y, z, got);
        expect([...got]).toEqual([...want]);
      }),
      { numRuns: 500 },
    );
    for (const count of met) expect(count).toBeGreaterThan(20);
  });

  it("is gone back by 1 µm from every place that it leads to", () => {
    const [there, source] = [new Float64Array(3), new Float64Array(3)];
    fc.assert(
      fc.property(share, share, share, (u, v, w) => {
        const point = [
          AREA.minX + u * (AREA.maxX - AREA.minX),
          AREA.minY + v * (AREA.maxY - AREA.minY),
          3000 * w,
        ] as const;
        whole.forward(...point, there);
        whole.inverse(there[0], there[1], there[2], source);
        // Where ways lead over each other, another point may lie at the same place.
        const back = new Float64Array(3);
        whole.forward(source[0], source[1], source[2], back);
        expect(distance(back, there)).toBeLessThan(1e-6);
      }),
      { numRuns: 300 },
    );
    expect(() => whole.inverse(0, 0, 0, source)).toThrow(PlacementError);
  });

  it("has the derivatives of the way that a point goes", () => {
    const [low, high, there] = [0, 0, 0].map(() => new Float64Array(3));
    const jacobian = new Float64Array(9);
    for (const [x, y] of [
      [495_123, 5_090_456],
      [503_900, 5_095_456],
      [503_900, 5_086_456],
    ]) {
      whole.jacobian(x, y, 100, jacobian);
      whole.forward(x - 0.5, y, 100, low);
      whole.forward(x + 0.5, y, 100, high);
      for (let axis = 0; axis < 3; axis++) expect(jacobian[3 * axis]).toBeCloseTo(high[axis] - low[axis], 6);
      whole.forward(x, y, 100, there);
    }
  });

  it("keeps the certificates of nodes, on whichever side of its borders, and on them", () => {
    const out = new Float64Array(3);
    const wayOf = (x: number, y: number) => {
      ways[0].evaluate(x, y, 0, out, 0);
      return Number.isFinite(out[0]) ? 0 : y >= BORDER ? 1 : 2;
    };
    const counts = { border: 0, needless: 0, fitted: 0 };
    const edges = fc.constantFrom(40, 300, 900);
    fc.assert(
      fc.property(share, share, edges, fc.integer({ min: 1, max: 1e6 }), (u, v, edge, chance) => {
        const minX = AREA.minX + u * (AREA.maxX - AREA.minX - edge);
        const minY = AREA.minY + v * (AREA.maxY - AREA.minY - edge);
        const domain: Domain = { minX, minY, minZ: 0, maxX: minX + edge, maxY: minY + edge, maxZ: 200 };
        const placement = fitPlacement(whole, domain, 0.001);
        const met = new Set(
          [0, 1, 2].flatMap((i) => [0, 1, 2].map((j) => wayOf(minX + (i * edge) / 2, minY + (j * edge) / 2))),
        );
        if (placement.scheme !== "exact") counts.fitted++;
        else if (met.size > 1) counts.border++;
        else counts.needless++;
        const next = random(chance);
        const count = 60;
        const scale = [edge / 2 ** 30, edge / 2 ** 30, 200 / 2 ** 30];
        const xyz = Int32Array.from({ length: 3 * count }, () => Math.floor(next() * 2 ** 30));
        const local = new Float32Array(3 * count);
        placeIntegers(placement, xyz, count, scale, [minX, minY, 0], local);
        const { origin, rotation: r } = placement.frame;
        const [want, got] = [new Float64Array(3), new Float64Array(3)];
        for (let i = 0; i < count; i++) {
          const [x, y, z] = [0, 1, 2].map((axis) => xyz[3 * i + axis] * scale[axis] + [minX, minY, 0][axis]);
          whole.forward(x, y, z, want);
          const [e, n, up] = local.subarray(3 * i, 3 * i + 3);
          for (let axis = 0; axis < 3; axis++) {
            got[axis] = origin[axis] + r[axis] * e + r[axis + 3] * n + r[axis + 6] * up;
          }
          expect(distance(got, want)).toBeLessThanOrEqual(placement.bound);
        }
      }),
      { numRuns: 150 },
    );
    // Nodes on a border go point by point, and hardly any others.
    expect(counts.border).toBeGreaterThan(0);
    expect(counts.fitted).toBeGreaterThan(50);
    expect(counts.needless).toBeLessThan(10);
  });

  it("puts both sides of a grid's end where their own way does, within one node", () => {
    // The end of the grid, north of the line between the other two ways.
    const [out, y] = [new Float64Array(3), BORDER + 300];
    let [x, beyond] = [AREA.minX, AREA.maxX];
    while (beyond - x > 1e-3) {
      ways[0].evaluate((x + beyond) / 2, y, 0, out, 0);
      if (Number.isFinite(out[0])) x = (x + beyond) / 2;
      else beyond = (x + beyond) / 2;
    }
    expect(x).toBeGreaterThan(AREA.minX + 1000);
    expect(x).toBeLessThan(AREA.maxX - 1000);
    const domain: Domain = { minX: x - 50, minY: y - 50, minZ: 0, maxX: x + 50, maxY: y + 50, maxZ: 10 };
    const placement = fitPlacement(whole, domain, 0.001);
    expect(placement.scheme).toBe("exact");
    expect(placement.bound).toBeLessThan(0.001);
  });

  it("takes other heights for all of its ways", () => {
    const { steps } = withHeights(chosen(seed), { metresPerUnit: 0.3048 });
    expect(steps.map(({ kind }) => kind)).toEqual(["projection", "choice", "geocentric"]);
    const out = new Float64Array(3);
    compileTransformation({ steps }).forward(503_900, 5_095_456, 1000, out);
    ecefToGeodetic(out[0], out[1], out[2], out);
    expect(out[2]).toBeCloseTo(304.8, 6);
  });
});
