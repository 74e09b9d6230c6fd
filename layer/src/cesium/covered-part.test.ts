import {
  BoundingSphere,
  Cartesian3,
  Cartesian4,
  Matrix4,
  OrthographicFrustum,
  OrthographicOffCenterFrustum,
  PerspectiveFrustum,
} from "cesium";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { coveredPart } from "./covered-part.js";
import type { FrustumLike } from "./engine/cesium-private.js";

const planes = { near: 1, far: 1e6 };
const FRUSTA = {
  perspective: new PerspectiveFrustum({ fov: 1, aspectRatio: 1.5, ...planes }),
  "perspective off the middle": new PerspectiveFrustum({ fov: 1, aspectRatio: 1.5, xOffset: 0.2, ...planes }),
  orthographic: new OrthographicFrustum({ width: 300, aspectRatio: 1.5, ...planes }),
  "orthographic off the middle": new OrthographicOffCenterFrustum({
    ...{ left: -50, right: 250, bottom: -80, top: 120 },
    ...planes,
  }),
};
/** A camera that stands somewhere and looks along −z. */
const VIEW = Matrix4.fromTranslation(new Cartesian3(-10, 20, -30));

function partOf(frustum: object, spheres: readonly BoundingSphere[], margin: [number, number] = [0, 0]) {
  const orthographic = !(frustum instanceof PerspectiveFrustum);
  const part = coveredPart(VIEW, { frustum: frustum as FrustumLike, orthographic }, spheres, margin);
  return [part.x, part.y, part.z, part.w];
}

const coordinate = fc.double({ min: -400, max: 400, noNaN: true });
const sphere = fc
  .tuple(coordinate, coordinate, coordinate, fc.double({ min: 0.1, max: 150, noNaN: true }))
  .map(([x, y, z, radius]) => new BoundingSphere(new Cartesian3(x, y, z), radius));
const direction = fc
  .tuple(coordinate, coordinate, coordinate)
  .filter((along) => Math.hypot(...along) > 1e-3)
  .map((along) => Cartesian3.normalize(Cartesian3.fromArray(along), new Cartesian3()));

describe("coveredPart", () => {
  it.each(Object.entries(FRUSTA))("holds all that shows of any sphere (%s)", (_, frustum) => {
    const spheres = fc.array(sphere, { minLength: 1, maxLength: 4 });
    const check = (balls: BoundingSphere[], ways: Cartesian3[]) => {
      const [left, bottom, right, top] = partOf(frustum, balls) as [number, number, number, number];
      for (const { center, radius } of balls) {
        for (const way of ways) {
          const place = Cartesian3.multiplyByScalar(way, radius, new Cartesian3());
          Cartesian3.add(center, place, place);
          Matrix4.multiplyByPoint(VIEW, place, place);
          const { projectionMatrix } = frustum as FrustumLike;
          const clip = Matrix4.multiplyByVector(
            projectionMatrix,
            new Cartesian4(place.x, place.y, place.z, 1),
            new Cartesian4(),
          );
          const [x, y] = [clip.x / clip.w, clip.y / clip.w];
          if (-place.z < planes.near || Math.abs(x) > 1 || Math.abs(y) > 1) continue;
          expect(x).toBeGreaterThanOrEqual(left - 1e-9);
          expect(x).toBeLessThanOrEqual(right + 1e-9);
          expect(y).toBeGreaterThanOrEqual(bottom - 1e-9);
          expect(y).toBeLessThanOrEqual(top + 1e-9);
        }
      }
    };
    fc.assert(fc.property(spheres, fc.array(direction, { minLength: 8, maxLength: 8 }), check), {
      numRuns: 200,
    });
  });

  it("is little more than a sphere far away, with its margin, and all where one is beside the camera", () => {
    const far = new BoundingSphere(new Cartesian3(10, -20, -1970), 20);
    const [left, bottom, right, top] = partOf(FRUSTA.perspective, [far], [0.01, 0.02]) as number[];
    const width = 20 / 2000 / Math.tan(0.5);
    expect(right).toBeCloseTo(width + 0.01, 3);
    expect(left).toBeCloseTo(-width - 0.01, 3);
    expect(top).toBeCloseTo(1.5 * width + 0.02, 3);
    expect(bottom).toBeCloseTo(-1.5 * width - 0.02, 3);
    const beside = new BoundingSphere(new Cartesian3(10, 0, 30), 25);
    expect(partOf(FRUSTA.perspective, [far, beside])).toEqual([-1, -1, 1, 1]);
  });

  it("is nothing where all is behind the camera", () => {
    const [left, , right] = partOf(FRUSTA.perspective, [
      new BoundingSphere(new Cartesian3(10, -20, 100), 5),
    ]) as number[];
    expect(left).toBeGreaterThanOrEqual(right!);
  });
});
