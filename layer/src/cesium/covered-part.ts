import { type BoundingSphere, Cartesian4, Matrix4 } from "cesium";
import type { PointFrustum } from "./point-frustum.js";

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
  const view = Matrix4.toArray(viewMatrix);
  const [scaleX, , , , , scaleY, , , shiftX, shiftY, , , moveX, moveY] = Matrix4.toArray(projectionMatrix);
  let left = Number.POSITIVE_INFINITY;
  let bottom = Number.POSITIVE_INFINITY;
  let right = Number.NEGATIVE_INFINITY;
  let top = Number.NEGATIVE_INFINITY;
  for (const { center, radius } of spheres) {
    const x = view[0] * center.x + view[4] * center.y + view[8] * center.z + view[12];
    const y = view[1] * center.x + view[5] * center.y + view[9] * center.z + view[13];
    const depth = -(view[2] * center.x + view[6] * center.y + view[10] * center.z + view[14]);
    if (depth + radius <= 0) continue;
    // Beside the camera a sphere may show anywhere.
    if (!orthographic && depth - radius < near) return Cartesian4.fromElements(-1, -1, 1, 1, result);
    // Without perspective a length takes as much at any depth.
    const nearest = orthographic ? 1 : 1 / (depth - radius);
    const farthest = orthographic ? 1 : 1 / (depth + radius);
    const [west, east] = [x - radius, x + radius];
    const [south, north] = [y - radius, y + radius];
    left = Math.min(left, west * (west < 0 ? nearest : farthest));
    right = Math.max(right, east * (east < 0 ? farthest : nearest));
    bottom = Math.min(bottom, south * (south < 0 ? nearest : farthest));
    top = Math.max(top, north * (north < 0 ? farthest : nearest));
  }
  const aside = orthographic ? moveX : -shiftX;
  const up = orthographic ? moveY : -shiftY;
  return Cartesian4.fromElements(
    within(scaleX * left + aside - beside),
    within(scaleY * bottom + up - above),
    within(scaleX * right + aside + beside),
    within(scaleY * top + up + above),
    result,
  );
}

/** The place in the picture that is nearest to one on its plane. */
function within(place: number): number {
  return Math.min(Math.max(place, -1), 1);
}
