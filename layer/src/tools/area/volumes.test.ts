import fc from "fast-check";
import { describe, expect, it } from "vitest";
import type { QueryVolume } from "../../query/index.js";
import { BoxVolume } from "./box-volume.js";
import { PolygonVolume } from "./polygon-volume.js";

type Corner = readonly [number, number];

/** Whole numbers, for which even-odd and edges are decided without rounding by plain arithmetic. */
const whole = fc.integer({ min: -20, max: 20 });
const corner = fc.tuple(whole, whole);
const rings = fc.array(fc.uniqueArray(corner, { minLength: 3, maxLength: 12, selector: String }), {
  minLength: 1,
  maxLength: 3,
});

/** Even-odd by integers, edges included. */
function holds(given: readonly (readonly Corner[])[], x: number, y: number): boolean {
  let inside = false;
  for (const ring of given) {
    for (const [index, [ax, ay]] of ring.entries()) {
      const [bx, by] = ring[(index + 1) % ring.length];
      const across = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
      const between = (x - ax) * (x - bx) <= 0 && (y - ay) * (y - by) <= 0;
      if (across === 0 && between) return true;
      if (ay > y !== by > y && across > 0 === by > ay) inside = !inside;
    }
  }
  return inside;
}

function expectAgreement(volume: QueryVolume, x: number, y: number, edge: number): void {
  const relation = volume.toBox(Float64Array.of(x, y, 0, x + edge, y + edge, edge));
  if (relation === "crossing") return;
  for (let i = 0; i <= 4; i++) {
    for (let j = 0; j <= 4; j++) {
      for (const z of [0, edge]) {
        const inside = volume.contains(x + (i / 4) * edge, y + (j / 4) * edge, z);
        expect(inside).toBe(relation === "in");
      }
    }
  }
}

describe("a polygon", () => {
  it("contains what the even-odd rule says, edges and corners too, and agrees with itself on boxes", () => {
    fc.assert(
      fc.property(
        rings,
        fc.array(corner, { minLength: 20, maxLength: 20 }),
        fc.integer({ min: 1, max: 8 }),
        (given, points, edge) => {
          const volume = new PolygonVolume(given);
          for (const [x, y] of points) {
            expect(volume.contains(x, y)).toBe(holds(given, x, y));
            expectAgreement(volume, x + 0.5, y, edge);
          }
        },
      ),
      { numRuns: 500 },
    );
  });

  it("decides exactly on which side of an edge a point is, far from the origin", () => {
    const [ax, ay, bx, by] = [600000.1, 200000.3, 600300.1, 200100.3];
    const volume = new PolygonVolume([
      [
        [ax, ay],
        [bx, by],
        [ax, by],
      ],
    ]);
    // The same edge without rounding: all of these are multiples of 2^-40 or so, so BigInt holds them.
    const exact = (value: number) => BigInt(value * 2 ** 40);
    for (let step = 1; step < 300; step++) {
      const x = ax + step;
      const y = ay + step / 3;
      const across =
        (exact(bx) - exact(ax)) * (exact(y) - exact(ay)) - (exact(by) - exact(ay)) * (exact(x) - exact(ax));
      expect(volume.contains(x, y)).toBe(across >= 0n);
    }
  });

  it("takes rings within rings for holes, closed or not", () => {
    const square = (edge: number): Corner[] => [
      [-edge, -edge],
      [edge, -edge],
      [edge, edge],
      [-edge, edge],
      [-edge, -edge],
    ];
    const volume = new PolygonVolume([square(10), square(5).slice(0, 4)]);
    expect([volume.contains(0, 0), volume.contains(7, 0), volume.contains(5, 0)]).toEqual([
      false,
      true,
      true,
    ]);
    expect(volume.toBox(Float64Array.of(-1, -1, 0, 1, 1, 9))).toBe("out");
    expect(volume.toBox(Float64Array.of(6, -1, 0, 7, 1, 9))).toBe("in");
  });

  it("refuses rings without area", () => {
    expect(() => new PolygonVolume([])).toThrow("no ring");
    expect(
      () =>
        new PolygonVolume([
          [
            [0, 0],
            [1, 1],
            [0, 0],
          ],
        ]),
    ).toThrow("three corners");
    expect(
      () =>
        new PolygonVolume([
          [
            [0, 0],
            [1, Number.NaN],
            [0, 1],
          ],
        ]),
    ).toThrow("not finite");
  });
});

describe("a box", () => {
  it("contains its sides, may be open, and agrees with itself on boxes", () => {
    const volume = new BoxVolume([0, 0, Number.NEGATIVE_INFINITY], [10, 10, 5]);
    expect(volume.contains(0, 10, -1e9)).toBe(true);
    expect(volume.contains(0, 10, 5.001)).toBe(false);
    fc.assert(
      fc.property(whole, whole, fc.integer({ min: 1, max: 8 }), (x, y, edge) =>
        expectAgreement(volume, x, y, edge),
      ),
    );
    expect(volume.toBox(Float64Array.of(1, 1, 0, 2, 2, 5))).toBe("in");
    expect(() => new BoxVolume([1, 0, 0], [0, 1, 1])).toThrow("above the greatest");
  });
});
