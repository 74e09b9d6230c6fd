import {
  BoundingSphere,
  type Camera,
  Cartesian3,
  OrthographicFrustum,
  OrthographicOffCenterFrustum,
  PerspectiveFrustum,
} from "cesium";
import { describe, expect, it } from "vitest";
import { fitFrustum } from "./point-frustum.js";

/** A camera at the origin that looks along x. */
const camera = (frustum: Camera["frustum"] | OrthographicOffCenterFrustum) =>
  ({
    positionWC: new Cartesian3(0, 0, 0),
    directionWC: new Cartesian3(1, 0, 0),
    frustum,
  }) as Camera;
const sphere = (x: number, radius: number) => new BoundingSphere(new Cartesian3(x, 0, 0), radius);
const perspective = () => new PerspectiveFrustum({ fov: 1, aspectRatio: 1.5, near: 0.1, far: 1e6 });

describe("fitFrustum", () => {
  it("takes the planes to the points and leaves the rest as it is", () => {
    const whole = perspective();
    const { frustum, orthographic } = fitFrustum(camera(whole), [sphere(100, 10), sphere(500, 20)]);
    expect([frustum.near, frustum.far, orthographic]).toEqual([90, 520, false]);
    expect(frustum).toMatchObject({ fov: 1, aspectRatio: 1.5 });
    expect([whole.near, whole.far]).toEqual([0.1, 1e6]);
  });

  it("stays within the camera's own planes", () => {
    const { frustum } = fitFrustum(camera(perspective()), [sphere(5, 10), sphere(2e6, 10)]);
    expect([frustum.near, frustum.far]).toEqual([0.1, 1e6]);
  });

  it("has some depth for a single place", () => {
    const { frustum } = fitFrustum(camera(perspective()), [sphere(100, 0)]);
    expect(frustum.far).toBeGreaterThan(frustum.near);
  });

  it("knows views without perspective, in the middle or beside it", () => {
    const centred = new OrthographicFrustum({ width: 10, aspectRatio: 1, near: 1, far: 100 });
    const beside = new OrthographicOffCenterFrustum({
      left: 0,
      right: 1,
      bottom: 0,
      top: 1,
      near: 1,
      far: 100,
    });
    for (const frustum of [centred, beside]) {
      expect(fitFrustum(camera(frustum), [sphere(50, 5)]).orthographic).toBe(true);
    }
  });
});
