import { describe, expect, it } from "vitest";
import { trustedBox } from "./trusted-box.js";

const cube = [1000, 2000, 0, 128] as const;
const node = (depth: number, x: number, y: number, z: number, pointCount = 1) => ({
  ...{ depth, x, y, z, pointCount, address: undefined },
});
type Corner = [number, number, number];
const box = (min: Corner, max: Corner, ...nodes: ReturnType<typeof node>[]) =>
  trustedBox({ min, max, scale: [0.01, 0.01, 0.01] }, cube, nodes);
const whole = { min: [1000, 2000, 0], max: [1128, 2128, 128] };

describe("trustedBox", () => {
  it("is what the header declares, where all nodes with points reach into it", () => {
    const flat = box(
      [1000, 2000, 5],
      [1128, 2128, 9],
      node(0, 0, 0, 0),
      node(3, 7, 7, 0),
      node(1, 0, 0, 1, 0),
    );
    expect(flat).toEqual({ boundingBox: { min: [1000, 2000, 5], max: [1128, 2128, 9] }, warnings: [] });
    // A single plane at the border of two cells, and a part of the cube.
    expect(box([1000, 2000, 64], [1128, 2128, 64], node(1, 0, 0, 0), node(1, 0, 0, 1)).warnings).toEqual([]);
    expect(box([1000, 2000, 0], [1030, 2030, 9], node(2, 0, 0, 0)).warnings).toEqual([]);
  });

  it.each<[string, Corner, Corner]>([
    ["all 0", [0, 0, 0], [0, 0, 0]],
    ["a part of the data", [1040, 2040, 10], [1050, 2050, 20]],
    ["of another place", [5000, 2000, 0], [5128, 2128, 128]],
    ["turned round", [1128, 2128, 128], [1000, 2000, 0]],
    ["no numbers", [Number.NaN, 2000, 0], [1128, 2128, 128]],
    ["without end", [1000, 2000, 0], [Number.POSITIVE_INFINITY, 2128, 128]],
  ])("is the octree's cube where the header's bounds are %s", (_, min, max) => {
    const { boundingBox, warnings } = box(min, max, node(0, 0, 0, 0), node(2, 3, 0, 1));
    expect(boundingBox).toEqual(whole);
    expect(warnings).toMatchObject([
      { code: "BOUNDS_WRONG", message: expect.stringContaining(`x ${min[0]}`) },
    ]);
  });

  it.each<[string, Corner, Corner, Corner, Corner]>([
    ["begin at 0", [0, 0, 0], [1128, 2100, 9], [1000, 2000, 0], [1128, 2100, 9]],
    ["are 1e300 wide", [-1e300, -1e300, -1e300], [1e300, 1e300, 1e300], [1000, 2000, 0], [1128, 2128, 128]],
  ])("is cut to the octree's cube where the header's bounds %s", (_, min, max, least, greatest) => {
    const { boundingBox, warnings } = box(min, max, node(0, 0, 0, 0), node(1, 1, 0, 0));
    expect(boundingBox).toEqual({ min: least, max: greatest });
    const message = expect.stringMatching(/reach beyond the octree .* cut to its cube/);
    expect(warnings).toEqual([{ code: "BOUNDS_WRONG", message }]);
  });

  it("is what the header declares, where that or the cube was rounded, or nothing lies in it", () => {
    const [min, max]: [Corner, Corner] = [
      [999, 1999, -1],
      [1129, 2129, 129],
    ];
    expect(box(min, max, node(0, 0, 0, 0))).toEqual({ boundingBox: { min, max }, warnings: [] });
    expect(box([0, 0, 0], [1000, 2000, 0], node(0, 0, 0, 0, 0)).warnings).toEqual([]);
  });

  it("does not go by nodes without points, nor by pages that are still to be read", () => {
    const corner = node(2, 3, 3, 3, 0);
    const page = node(2, 3, 3, 3, -1);
    expect(box([1000, 2000, 0], [1010, 2010, 9], node(0, 0, 0, 0), corner, page).warnings).toEqual([]);
  });
});
