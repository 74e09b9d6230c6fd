import { describe, expect, it } from "vitest";
import { encodeVisibleOctree, type VisibleNode } from "./visible-octree.js";

describe("the visible octree", () => {
  const node = (
    depth: number,
    x: number,
    y: number,
    z: number,
    parts: Partial<VisibleNode> = {},
  ): VisibleNode => ({
    key: { depth, x, y, z },
    points: 10_000,
    count: 10_000,
    leaf: false,
    spacing: 1 / 2 ** depth,
    box: [0, 0, 0, 100, 100, 10],
    ...parts,
  });

  it("is laid breadth first as the thesis draws it (fig. 4.16)", () => {
    // r, r3, r4, r30, r43: octants have x in bit 0, y in bit 1, z in bit 2.
    const nodes = [node(0, 0, 0, 0), node(1, 1, 1, 0), node(1, 0, 0, 1), node(2, 2, 2, 0), node(2, 1, 1, 2)];
    const { texture, indices } = encodeVisibleOctree(nodes);
    expect([...indices]).toEqual([0, 1, 2, 3, 4]);
    const texel = (index: number) => [...texture.subarray(4 * index, 4 * index + 3)];
    expect(texel(0)).toEqual([0b11000, 1, 0]);
    expect(texel(1)).toEqual([0b00000001, 2, 0]);
    expect(texel(2)).toEqual([0b00001000, 2, 0]);
    expect([texel(3), texel(4)]).toEqual([
      [0, 0, 0],
      [0, 0, 0],
    ]);
  });

  it("holds together where an ancestor is not drawn", () => {
    const { texture, indices } = encodeVisibleOctree([node(0, 0, 0, 0), node(3, 0, 0, 0)]);
    expect([...indices]).toEqual([0, 3]);
    expect(texture[4 * 2]).toBe(1);
  });

  it("says how far the points of a node lie apart, in sixteenths of a doubling of its level's spacing", () => {
    const { texture } = encodeVisibleOctree([node(0, 0, 0, 0, { count: 2500 }), node(1, 0, 0, 0)]);
    expect([texture[3], texture[7]]).toEqual([128 + 16, 128]);
  });
});
