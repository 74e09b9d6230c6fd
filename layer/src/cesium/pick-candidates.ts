import { type Camera, Cartesian2, Cartesian3, type Ray } from "cesium";
import type { WindowPosition } from "./layer-options.js";
import type { CesiumNode } from "./node-drawable.js";

const place = new Cartesian2();
const away = new Cartesian3();

/**
 * The nodes whose points can show near a place of the picture: those whose sphere the ray through it passes within the
 * length that the pixels around it have there.
 * @param position CSS pixels from the upper left
 * @param reach CSS pixels around it, half the width of a point included
 */
export function candidatesAt(
  camera: Camera,
  position: WindowPosition,
  reach: number,
  nodes: readonly CesiumNode[],
): CesiumNode[] {
  const ray = camera.getPickRay(Cartesian2.fromElements(position.x, position.y, place));
  const beside = camera.getPickRay(Cartesian2.fromElements(position.x + reach, position.y + reach, place));
  if (!ray || !beside) return [...nodes];
  const atOrigin = Cartesian3.distance(ray.origin, beside.origin);
  // Directions are of unit length, so their difference is the spread per metre; more off the axis, hence the factor.
  const perMetre = 2 * Cartesian3.distance(ray.direction, beside.direction);
  return nodes.filter(({ uploaded: { sphere } }) => {
    const along = Math.max(
      0,
      Cartesian3.dot(Cartesian3.subtract(sphere.center, ray.origin, away), ray.direction),
    );
    return (
      distanceTo(ray, sphere.center, along) <= sphere.radius + atOrigin + perMetre * (along + sphere.radius)
    );
  });
}

function distanceTo({ origin, direction }: Ray, point: Cartesian3, along: number): number {
  const foot = Cartesian3.multiplyByScalar(direction, along, away);
  Cartesian3.add(foot, origin, foot);
  return Cartesian3.distance(foot, point);
}
