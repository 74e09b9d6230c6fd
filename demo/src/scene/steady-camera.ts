import { Cartesian3, type Scene } from "cesium";

/** By how much a direction of length 1 may be another one by rounding alone. */
const ROUNDING = 1e-12;

/**
 * Keeps a camera that nobody moves from turning by rounding: a viewer of Cesium asks for its heading in each frame of the page,
 * and each time goes to another coordinate system and back. After some ten of these it would be a move, which draws the globe.
 */
export function steadyCamera({ camera, preUpdate, postRender }: Scene): void {
  const axes = () => [camera.direction, camera.up, camera.right];
  let drawn: Cartesian3[] = [];
  postRender.addEventListener(() => {
    drawn = axes().map((axis) => Cartesian3.clone(axis));
  });
  preUpdate.addEventListener(() => {
    const now = axes();
    if (!drawn.every((axis, at) => Cartesian3.equalsEpsilon(axis, now[at], 0, ROUNDING))) return;
    for (const [at, axis] of drawn.entries()) Cartesian3.clone(axis, now[at]);
  });
}
