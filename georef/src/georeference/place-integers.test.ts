import { describe, expect, it } from "vitest";
import type { Domain } from "../cartesian/domain.js";
import { random } from "../cartesian/points.fixture.js";
import { eastNorthUp } from "../ellipsoid/frame.js";
import { unfoldAll } from "./creases.js";
import { remainderOf } from "./grid-remainder.js";
import { place } from "./place.js";
import { placeIntegers } from "./place-integers.js";
import type { Placement } from "./placement.js";
import { reliefOf } from "./relief.js";
import { FITTED_SCHEMES, termCount } from "./scheme.js";

const domain: Domain = { minX: 1000, minY: -400, minZ: 20, maxX: 1300, maxY: 100, maxZ: 90 };
const frame = eastNorthUp([4e6, 7e5, 4.9e6]);
const BOUNDS = { bound: 1, fitBound: 1, storageBound: 1 };

/** Far from the middle of the domain, so that every scale and offset counts. */
const SCALE = [0.01, 0.02, 0.005];
const OFFSET = [900, 300, -10];

const next = random(7);
const chance = (count: number) => Float64Array.from({ length: count }, () => 2 * next() - 1);

/** A grid of 3 × 2 cells, which the node fills but for its margin. */
const CELLS = remainderOf(
  chance(3 * 4 * 3),
  3,
  2,
  Float64Array.of(1.5, 1.4, 0.03, 0.01, -0.02, 0.01, 1, -0.02, 0.9, 0.01, 0.015, -0.01),
);
/** One of 2 × 2, whose lines are two. */
const LINES = remainderOf(
  chance(3 * 3 * 3),
  2,
  2,
  Float64Array.of(1, 0.9, 0.03, 0.01, 0, 0, 1, -0.02, 0.9, 0, 0, -0.01),
);
const ADDED: Record<string, Partial<Placement>> = {
  nothing: {},
  "cells of a grid": { remainders: [CELLS] },
  "cells of two grids": { remainders: [CELLS, LINES] },
  "a relief": { relief: reliefOf(CELLS).relief },
  creases: { creases: unfoldAll([LINES])!.creases },
};

/** Records all over the domain, and their coordinates. */
function records(count: number): { xyz: Int32Array; at: (i: number) => [number, number, number] } {
  const { minX, minY, minZ, maxX, maxY, maxZ } = domain;
  const xyz = Int32Array.from({ length: 3 * count }, (_, i) => {
    const axis = i % 3;
    const [least, greatest] = [
      [minX, maxX],
      [minY, maxY],
      [minZ, maxZ],
    ][axis];
    return Math.round((least + next() * (greatest - least) - OFFSET[axis]) / SCALE[axis]);
  });
  const at = (i: number) =>
    [0, 1, 2].map((axis) => xyz[3 * i + axis] * SCALE[axis] + OFFSET[axis]) as [number, number, number];
  return { xyz, at };
}

/** ECEF → node frame. */
function toFrame({ origin, rotation: r }: Placement["frame"], ecef: ArrayLike<number>): number[] {
  const d = [0, 1, 2].map((axis) => ecef[axis] - origin[axis]);
  return [0, 3, 6].map((from) => r[from] * d[0] + r[from + 1] * d[1] + r[from + 2] * d[2]);
}

describe("placing integers", () => {
  const cases = FITTED_SCHEMES.flatMap((scheme) => Object.keys(ADDED).map((added) => ({ scheme, added })));

  it.each(cases)("by $scheme with $added is placing points, in float32", ({ scheme, added }) => {
    const terms = termCount(scheme, "P") + termCount(scheme, "n");
    const placement: Placement = {
      ...{ scheme, ...BOUNDS, frame, coefficients: chance(3 * terms), domain, remainders: [] },
      ...ADDED[added],
    };
    const count = 200;
    const { xyz, at } = records(count + 5);
    const out = new Float32Array(3 * (count + 5)).fill(Number.NaN);
    placeIntegers(placement, xyz, count, SCALE, OFFSET, out);
    // Nothing is written behind the last point.
    expect([...out.subarray(3 * count)]).toEqual(new Array(15).fill(Number.NaN));
    const ecef = new Float64Array(3);
    for (let i = 0; i < count; i++) {
      place(placement, ...at(i), ecef);
      const local = toFrame(frame, ecef);
      // The sum of up to a hundred coefficients of 1 is rounded a few times; ECEF costs a nanometre.
      for (let axis = 0; axis < 3; axis++) {
        expect(Math.abs(out[3 * i + axis] - local[axis])).toBeLessThan(6 * 2 ** -24 * 16 + 2e-8);
      }
    }
  });

  it("takes the transform itself where nothing was fitted", () => {
    const exact: Placement["exact"] = (x, y, z, out, offset) => {
      const [east, north, up] = [x / 2 - y, y + 0.1 * z * z, z - 0.01 * x * y];
      for (let axis = 0; axis < 3; axis++) {
        const { origin, rotation: r } = frame;
        out[offset + axis] = origin[axis] + east * r[axis] + north * r[axis + 3] + up * r[axis + 6];
      }
    };
    const placement: Placement = {
      ...{
        scheme: "exact",
        ...BOUNDS,
        frame,
        coefficients: new Float64Array(),
        domain,
        remainders: [],
        exact,
      },
    };
    const { xyz, at } = records(50);
    const out = new Float32Array(150).fill(Number.NaN);
    placeIntegers(placement, xyz, 40, SCALE, OFFSET, out);
    for (let i = 0; i < 40; i++) {
      const [x, y, z] = at(i);
      const expected = [x / 2 - y, y + 0.1 * z * z, z - 0.01 * x * y];
      for (let axis = 0; axis < 3; axis++) {
        const off = Math.abs(out[3 * i + axis] - expected[axis]);
        expect(off).toBeLessThan(2 ** -23 * Math.abs(expected[axis]) + 1e-8);
      }
    }
    expect([...out.subarray(120)]).toEqual(new Array(30).fill(Number.NaN));
    const { exact: _, ...without } = placement;
    expect(() => placeIntegers(without, xyz, 1, SCALE, OFFSET, out)).toThrow("carries its transform");
  });
});
