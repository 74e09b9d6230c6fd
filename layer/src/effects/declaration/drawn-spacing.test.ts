import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { groundSpacing } from "../ground-spacing.js";
import { type DrawnDensity, drawnSpacing } from "./drawn-spacing.js";

const node = (parts: Partial<DrawnDensity>): DrawnDensity => ({
  key: { depth: 6, x: 0, y: 0, z: 0 },
  points: 10_000,
  count: 10_000,
  leaf: false,
  spacing: 1,
  box: [0, 0, 0, 100, 100, 2],
  ...parts,
});

describe("the distance between drawn points", () => {
  it("of an inner node goes from that of the level above to its own as it is drawn", () => {
    expect(drawnSpacing(node({}))).toBe(1);
    expect(drawnSpacing(node({ count: 1 }))).toBeCloseTo(2, 3);
    // A quarter of the density is there already: with half of the rest 5/8.
    expect(drawnSpacing(node({ count: 5_000 }))).toBeCloseTo(Math.sqrt(8 / 5), 9);
    // There is nothing above a root.
    const key = { depth: 0, x: 0, y: 0, z: 0 };
    expect(drawnSpacing(node({ key, count: 2_500 }))).toBeCloseTo(2, 9);
  });

  it("of a leaf is what its points make of it: denser and sparser than its level says", () => {
    const leaf = (parts: Partial<DrawnDensity>) => drawnSpacing(node({ leaf: true, ...parts }));
    // As many points as cells, and those of the levels above between them.
    expect(leaf({})).toBeCloseTo(Math.sqrt(4 / 5), 9);
    // All points in a tenth of the node's width: the area, not the node, decides.
    expect(leaf({ box: [0, 0, 0, 10, 10, 1] })).toBeCloseTo(0.1, 2);
    // Next to no points of its own: those of the levels above.
    expect(leaf({ count: 1 })).toBeCloseTo(2, 2);
    // A wall stands on its longer sides too.
    expect(leaf({ box: [0, 0, 0, 0, 100, 100] })).toBeCloseTo(Math.sqrt(4 / 5), 9);
  });

  it("never grows with the points that are drawn", () => {
    const drawn = fc.record({
      points: fc.integer({ min: 1, max: 100_000 }),
      depth: fc.integer({ min: 0, max: 20 }),
      leaf: fc.boolean(),
      spacing: fc.double({ min: 1e-3, max: 1e3, noNaN: true }),
      shares: fc.tuple(
        fc.double({ min: 0, max: 1, noNaN: true }),
        fc.double({ min: 0, max: 1, noNaN: true }),
      ),
    });
    fc.assert(
      fc.property(drawn, ({ points, depth, leaf, spacing, shares }) => {
        const [few, many] = shares
          .toSorted((a, b) => a - b)
          .map((share) => Math.max(1, Math.floor(share * points)))
          .map((count) =>
            drawnSpacing(node({ key: { depth, x: 0, y: 0, z: 0 }, points, count, leaf, spacing })),
          );
        expect(many).toBeLessThanOrEqual(few!);
        expect(many).toBeGreaterThan(0);
        if (!leaf && depth > 0) expect(few).toBeLessThanOrEqual(2 * spacing * (1 + 1e-12));
      }),
    );
  });
});

/** What parts of a picture, each with its spacing and its pixels, are bridged by. */
function bridgedBy(patches: readonly { readonly spacing: number; readonly pixels: number }[]): number {
  const spacings = Float64Array.from(patches, ({ spacing }) => spacing);
  return groundSpacing(
    spacings,
    Float64Array.from(patches, ({ pixels }) => pixels),
  );
}

describe("the distance that one size on the ground bridges", () => {
  it("is the median over the picture, whatever the order", () => {
    const fine = { spacing: 1, pixels: 400 };
    const middle = { spacing: 2, pixels: 300 };
    const coarse = { spacing: 9, pixels: 300 };
    expect(bridgedBy([coarse, fine, middle])).toBe(2);
    expect(bridgedBy([fine, { ...middle, pixels: 50 }, { ...coarse, pixels: 50 }])).toBe(1);
    expect(bridgedBy([])).toBe(0);
  });

  it("is what going through all in rising order comes to", () => {
    const patch = fc.record({
      // Few spacings, so that many parts have the same, or any.
      spacing: fc.oneof(fc.integer({ min: 1, max: 5 }), fc.double({ min: 1e-3, max: 1e3, noNaN: true })),
      pixels: fc.integer({ min: 0, max: 1e6 }),
    });
    fc.assert(
      fc.property(fc.array(patch, { minLength: 1, maxLength: 200 }), (patches) => {
        const rising = [...patches].sort((a, b) => a.spacing - b.spacing);
        let left = rising.reduce((sum, { pixels }) => sum + pixels, 0) / 2;
        const median = rising.find(({ pixels }) => {
          left -= pixels;
          return left <= 0;
        });
        expect(bridgedBy(patches)).toBe(median?.spacing);
      }),
    );
  });
});
