import { Cartesian3, Cartesian4, type CullingVolume, PerspectiveFrustum } from "cesium";
import { describe, expect, it } from "vitest";
import { outsideFrustum } from "../octree/index.js";
import type { FrameState } from "./engine/cesium-private.js";
import { viewOfFrame } from "./frame-camera.js";

/** A camera at x = 100 that looks along −x and sees what lies between x = 0 and 100. */
const frame = {
  camera: {
    positionWC: new Cartesian3(100, 0, 0),
    directionWC: new Cartesian3(-1, 0, 0),
    frustum: new PerspectiveFrustum({ fov: 1, aspectRatio: 1 }),
  },
  cullingVolume: { planes: [new Cartesian4(1, 0, 0, 0), new Cartesian4(-1, 0, 0, 100)] } as CullingVolume,
  context: { drawingBufferHeight: 600 },
  occluder: undefined,
} as unknown as FrameState;

const sphere = (x: number) => ({ x, y: 0, z: 0, radius: 5, spacing: 1 });

describe("viewOfFrame", () => {
  it("is the camera itself where points are drawn in their places", () => {
    const view = viewOfFrame(frame, [0, 0, 0]);
    expect([...Array.from(view.position), view.height]).toEqual([100, 0, 0, 600]);
    expect([-10, 0, 100, 110].map((x) => outsideFrustum(view, sphere(x)))).toEqual([
      true,
      false,
      false,
      true,
    ]);
  });

  it("sees the places of points that are drawn elsewhere", () => {
    const view = viewOfFrame(frame, [30, 0, 0]);
    expect(view.position[0]).toBe(70);
    expect([-40, -30, 70, 80].map((x) => outsideFrustum(view, sphere(x)))).toEqual([
      true,
      false,
      false,
      true,
    ]);
  });
});
