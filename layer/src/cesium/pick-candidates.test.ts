import { BoundingSphere, type Camera, type Cartesian2, Cartesian3, Ray } from "cesium";
import { describe, expect, it } from "vitest";
import type { CesiumNode } from "./node-drawable.js";
import { candidatesAt } from "./pick-candidates.js";

/** Looks along x from the origin; a pixel is 1 mrad, and the middle is at 0, 0. */
const perspective = {
  getPickRay: ({ x, y }: Cartesian2) =>
    new Ray(new Cartesian3(), Cartesian3.normalize(new Cartesian3(1, x / 1000, y / 1000), new Cartesian3())),
} as unknown as Camera;
/** The same without perspective: a pixel is 10 cm. */
const parallel = {
  getPickRay: ({ x, y }: Cartesian2) => new Ray(new Cartesian3(0, x / 10, y / 10), new Cartesian3(1, 0, 0)),
} as unknown as Camera;

const node = (x: number, y: number, radius: number) =>
  ({ uploaded: { sphere: new BoundingSphere(new Cartesian3(x, y, 0), radius) } }) as unknown as CesiumNode;

describe("candidatesAt", () => {
  it("keeps what the ray passes, and what lies a point's width beside it", () => {
    const [through, beside, away, behind] = [
      node(100, 0, 1),
      node(1000, 11, 1),
      node(1000, 60, 1),
      node(-50, 0, 1),
    ];
    const kept = candidatesAt(perspective, { x: 0, y: 0 }, 10, [through, beside, away, behind]);
    expect(kept).toEqual([through, beside]);
  });

  it("keeps a node around the camera", () => {
    const around = node(0, 3, 5);
    expect(candidatesAt(perspective, { x: 0, y: 0 }, 10, [around])).toEqual([around]);
  });

  it("goes by lengths where there is no perspective", () => {
    const [near, far] = [node(1000, 1.5, 1), node(1000, 4, 1)];
    expect(candidatesAt(parallel, { x: 0, y: 0 }, 10, [near, far])).toEqual([near]);
  });
});
