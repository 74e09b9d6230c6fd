import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { silhouettesOf } from "./silhouettes.js";

const NONE = Number.NaN;
const of = (width: number, ...metres: number[]) =>
  silhouettesOf(
    Float64Array.from(metres, (depth) => Math.log2(depth)),
    width,
  );

describe("silhouettes", () => {
  it("are the pixels on both sides of a step of one hundredth", () => {
    expect(of(4, 10, 10, 10.11, 10.11, 10, 10, 10.11, 10.11)).toEqual({ covered: 8, steps: 4 });
    expect(of(4, 10, 10, 10.09, 10.09, 10, 10, 10.09, 10.09)).toEqual({ covered: 8, steps: 0 });
    expect(of(2, 10, 10, 20, 20, 20, 20)).toEqual({ covered: 6, steps: 4 });
  });

  it("are not where nothing is drawn, nor across the ends of rows", () => {
    expect(of(3, 10, NONE, 20, NONE, NONE, NONE)).toEqual({ covered: 2, steps: 0 });
    expect(of(2, 10, 20, 10, 20)).toEqual({ covered: 4, steps: 4 });
    // The end of one row and the beginning of the next.
    expect(of(2, 10, 10, 10, 10).steps).toBe(0);
    expect(of(3, 10, 10, 10, NONE, NONE, 30, 10, 10, 10)).toEqual({ covered: 7, steps: 3 });
  });

  it("are the same at another size and distance, and in a mirror", () => {
    const picture = fc.array(fc.option(fc.double({ min: 1, max: 1.1, noNaN: true }), { nil: NONE }), {
      minLength: 12,
      maxLength: 12,
    });
    fc.assert(
      fc.property(picture, fc.constantFrom(0.5, 4, 1024), (depths, factor) => {
        const there = of(4, ...depths);
        expect(of(4, ...depths.map((depth) => factor * depth))).toEqual(there);
        expect(of(4, ...depths.toReversed())).toEqual(there);
        expect(there.steps).toBeLessThanOrEqual(there.covered);
      }),
    );
  });
});
