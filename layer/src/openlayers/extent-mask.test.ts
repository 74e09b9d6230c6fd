import { describe, expect, it } from "vitest";
import { sidesOf } from "./extent-mask.js";

describe("the sides of an extent", () => {
  const within = (sides: number[], x: number, y: number) =>
    [0, 4, 8, 12].every((at) => sides[at]! * x + sides[at + 1]! * y + sides[at + 2]! >= 0);

  it("have its pixels within, counted from below, whichever way its corners go", () => {
    const corners = [
      [10, 40],
      [30, 40],
      [30, 20],
      [10, 20],
    ];
    for (const given of [corners, [...corners].reverse()]) {
      const sides = sidesOf(given, 2, 100);
      expect(within(sides, 40, 40)).toBe(true);
      for (const [x, y] of [
        [19, 40],
        [61, 40],
        [40, 19],
        [40, 61],
      ] as const) {
        expect(within(sides, x, y)).toBe(false);
      }
    }
  });
});
