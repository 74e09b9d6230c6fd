import type { Vector } from "@groma/georef";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { lackByPairs, lackOf } from "./lack.js";

const number = (most: number) => fc.double({ min: -most, max: most, noNaN: true });
const vector = (most: number) => fc.tuple(number(most), number(most), number(most));

describe("what errors of near points lack of a common one", () => {
  it("is by moments what it is by pairs", () => {
    const members = fc.array(fc.tuple(vector(700), vector(50)), { minLength: 9, maxLength: 40 });
    fc.assert(
      fc.property(members, fc.constantFrom(1e5, 2e5, 6e5), (of, reach) => {
        const places = of.map(([[x, y, z]]): Vector => [4.2e6 + x, 8e5 + y, 4.6e6 + z]);
        const weights = of.map(([, weight]): Vector => weight);
        const [quick, each] = [lackOf(places, weights, reach), lackByPairs(places, weights, reach)];
        // Against what the terms are in size: signs let their sum be nothing.
        const size = lackByPairs(
          places,
          weights.map((one): Vector => [Math.hypot(...one), 0, 0]),
          reach,
        ).lack;
        expect(Math.abs(quick.lack - each.lack)).toBeLessThanOrEqual(3e-4 * size + 1e-12);
        expect(quick.correlation).toBeGreaterThan(0.999);
        expect(quick.correlation).toBeLessThanOrEqual(each.correlation);
      }),
    );
  });

  it("is told by pairs for few points, and for points far from each other", () => {
    const far: Vector[] = Array.from({ length: 12 }, (_, i) => [1e5 * i, 0, 0]);
    const weights = far.map((): Vector => [1, 0, 0]);
    expect(lackOf(far, weights, 1e5)).toEqual(lackByPairs(far, weights, 1e5));
    const few = far.slice(0, 2).map(([x]): Vector => [x! / 1e4, 0, 0]);
    expect(lackOf(few, weights.slice(0, 2), 1e5)).toEqual(lackByPairs(few, weights, 1e5));
    // Nothing of a rigid body is apart.
    expect(lackOf(far, weights, Number.POSITIVE_INFINITY)).toEqual({ lack: 0, correlation: 1 });
  });
});
