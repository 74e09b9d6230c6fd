import { type BoundingSphere, Cartesian3, Cartesian4, Matrix4 } from "cesium";
import type { PointFrustum } from "./point-frustum.js";

const eye = new Cartesian3();

/**
 * The part of the picture that spheres lie in, as left, bottom, right and top in normalized device coordinates, from −1 to 1;
 * somewhat larger than need be.
 * @param viewMatrix ECEF → eye
 * @param spheres ECEF, metres
 * @param margin width and height that are added on each side, of the whole picture of 2 by 2
 */
export function coveredPart(
  viewMatrix: Matrix4,
  { frustum: { projectionMatrix, near }, orthographic }: PointFrustum,
  spheres: Iterable<BoundingSphere>,
  [beside, above]: readonly [number, number],
  result = new Cartesian4(),
): Cartesian4 {
  const [scaleX, , , , , scaleY, , , shiftX, shiftY, , , moveX, moveY] = Matrix4.toArray(projectionMatrix);
  let [left, bottom, right, top] = [1, 1, -1, -1];
  for (const { center, radius } of spheres) {
    const { x, y, z } = Matrix4.multiplyByPoint(viewMatrix, center, eye);
    const nearest = orthographic ? 1 : -z - radius;
    const farthest = orthographic ? 1 : -z + radius;
    if (farthest <= 0) continue;
    // Beside the camera a sphere may show anywhere.
    if (nearest < near && !orthographic) return Cartesian4.fromElements(-1, -1, 1, 1, result);
    const [aside, up] = orthographic ? [moveX, moveY] : [-shiftX, -shiftY];
    left = Math.min(left, least(scaleX * (x - radius), nearest, farthest) + aside);
    right = Math.max(right, -least(-scaleX * (x + radius), nearest, farthest) + aside);
    bottom = Math.min(bottom, least(scaleY * (y - radius), nearest, farthest) + up);
    top = Math.max(top, -least(-scaleY * (y + radius), nearest, farthest) + up);
  }
  const within = (place: number) => Math.min(Math.max(place, -1), 1);
  return Cartesian4.fromElements(
    within(left - beside),
    within(bottom - above),
    within(right + beside),
    within(top + above),
    result,
  );
}

/** The least that a length takes on screen at any depth between two. */
function least(length: number, nearest: number, farthest: number): number {
  return length / (length < 0 ? nearest : farthest);
}
