import {
  type BoundingSphere,
  type Camera,
  Interval,
  OrthographicFrustum,
  OrthographicOffCenterFrustum,
  type PerspectiveFrustum,
  type PerspectiveOffCenterFrustum,
} from "cesium";
import type { FrustumLike } from "./engine/cesium-private.js";

/** A camera's frustum with the near and far planes that the points need. */
export interface PointFrustum {
  readonly frustum: FrustumLike;
  /** Whether lengths do not shrink with distance; depth is linear then. */
  readonly orthographic: boolean;
}

/** Any frustum that Cesium's camera can have. */
type CameraFrustum =
  | PerspectiveFrustum
  | PerspectiveOffCenterFrustum
  | OrthographicFrustum
  | OrthographicOffCenterFrustum;

/** Least ratio of far to near. */
const THINNEST = 1.000001;

const interval = new Interval();

/**
 * The camera's frustum between the nearest and the farthest sphere. Cesium cuts the whole scene into several frusta
 * where depth is not logarithmic; points that are drawn into a picture of their own need one only.
 */
export function fitFrustum(camera: Camera, spheres: Iterable<BoundingSphere>): PointFrustum {
  const whole = camera.frustum as CameraFrustum;
  let near = Number.POSITIVE_INFINITY;
  let far = 0;
  for (const sphere of spheres) {
    const { start, stop } = sphere.computePlaneDistances(camera.positionWC, camera.directionWC, interval);
    near = Math.min(near, start);
    far = Math.max(far, stop);
  }
  const frustum = whole.clone() as CameraFrustum;
  frustum.near = Math.min(Math.max(near, whole.near), whole.far);
  frustum.far = Math.max(Math.min(far, whole.far), frustum.near * THINNEST);
  return { frustum: frustum as FrustumLike, orthographic: isOrthographic(whole) };
}

/** Whether lengths do not shrink with distance. */
export function isOrthographic(frustum: CameraFrustum | Camera["frustum"]): boolean {
  return frustum instanceof OrthographicFrustum || frustum instanceof OrthographicOffCenterFrustum;
}
