import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { ancestorAt, isWithin, keyName, octant, parseKey, ROOT_KEY, sameKey } from "./voxel-key.js";

const key = fc.integer({ min: 0, max: 31 }).chain((depth) => {
  const index = fc.integer({ min: 0, max: 2 ** depth - 1 });
  return fc.record({ depth: fc.constant(depth), x: index, y: index, z: index });
});

describe("VoxelKey", () => {
  it("survives its name", () => {
    fc.assert(
      fc.property(key, (k) => {
        expect(parseKey(keyName(k))).toEqual(k);
      }),
    );
  });

  it.each(["", "0-0-0", "1-2-0-0", "32-0-0-0", "1-0-0-0 ", "a-0-0-0", "1--1-0-0"])("%j is no key", (name) =>
    expect(parseKey(name)).toBeUndefined(),
  );

  it("lies within each of its ancestors, up to the root", () => {
    fc.assert(
      fc.property(key, (k) => {
        for (let depth = k.depth; depth >= 0; depth--) expect(isWithin(k, ancestorAt(k, depth))).toBe(true);
        expect(sameKey(ancestorAt(k, 0), ROOT_KEY)).toBe(true);
      }),
    );
  });

  it("lies in no sibling", () => {
    expect(isWithin({ depth: 2, x: 3, y: 0, z: 0 }, { depth: 1, x: 0, y: 0, z: 0 })).toBe(false);
    expect(isWithin({ depth: 0, x: 0, y: 0, z: 0 }, { depth: 1, x: 0, y: 0, z: 0 })).toBe(false);
  });

  it("numbers the eight children apart", () => {
    const numbers = new Set<number>();
    for (let n = 0; n < 8; n++) numbers.add(octant({ depth: 1, x: n & 1, y: (n >> 1) & 1, z: n >> 2 }));
    expect([...numbers].sort()).toEqual([0, 1, 2, 3, 4, 5, 6, 7]);
  });
});
