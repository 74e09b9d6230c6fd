import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { distance, number } from "../../camera/poses.fixture.js";
import { keepClear } from "./index.js";

describe("keeping clear of points", () => {
  /** A wall at x = 0, a point each half metre. */
  const wall = Array.from({ length: 41 * 41 }, (_, at) => [
    0,
    (at % 41) / 2 - 10,
    Math.floor(at / 41) / 2 - 10,
  ]).flat();
  const within = number(-4, 4);

  it("never comes nearer than the clearance, nor through", () => {
    fc.assert(
      fc.property(number(1, 8), within, within, number(-8, 8), within, within, (x, y, z, tx, ty, tz) => {
        const found = keepClear([x, y, z], [tx, ty, tz], 1, wall);
        expect(found[0]).toBeGreaterThan(0.85);
        // Where nothing is in the way, it goes all of it.
        if (tx > 1) expect(distance(found, [tx, ty, tz])).toBeLessThan(1e-9);
      }),
    );
  });

  it("jumps over nothing, however far it is to go", () => {
    for (const far of [5, 50, 5000])
      expect(keepClear([3, 0, 0], [-far, 0.1, 0], 1, wall)[0]).toBeGreaterThan(0.85);
    expect(keepClear([300, 0, 0], [250, 0, 0], 1, wall)).toEqual([250, 0, 0]);
  });

  it("slides along, and leaves what begins too near where it is", () => {
    const slid = keepClear([3, -5, 0], [-3, 5, 0], 1, wall);
    expect(slid[1]).toBeGreaterThan(1);
    expect(keepClear([0.2, 0, 0], [0.2, 0, 0], 1, wall)).toEqual([0.2, 0, 0]);
    const out = keepClear([0.2, 0, 0], [0.6, 0, 0], 1, wall);
    expect(out[0]).toBeCloseTo(0.6, 9);
    expect(keepClear([0.2, 0, 0], [-0.5, 0, 0], 1, wall)[0]).toBeGreaterThan(0.15);
  });
});
