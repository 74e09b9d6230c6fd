import { cross, difference, dot, eastNorthUp, pointOf, type Vector } from "@groma/georef";
import type { Ground } from "./view-shot.js";

/** Where a camera stands and how it is turned, ECEF: metres, and unit vectors. */
interface Pose {
  readonly position: Vector;
  readonly direction: Vector;
  readonly up: Vector;
}

/** Pixels to the north of the middle at which it is looked where north is. */
const STEP = 10;

/**
 * Scale and north of the ground that a camera sees in the middle of its picture.
 * @param depth of the ground along the camera's direction, metres
 * @param tangentPerPixel of the angle that a CSS pixel in the middle takes
 * @returns undefined where the camera sees no ground
 */
export function groundAt(pose: Pose, depth: number, tangentPerPixel: number): Ground | undefined {
  if (!(depth > 0 && Number.isFinite(depth))) return undefined;
  const { position, direction, up } = pose;
  const along = (axis: 0 | 1 | 2) => position[axis] + depth * direction[axis];
  const place: Vector = [along(0), along(1), along(2)];
  const metresPerPixel = depth * tangentPerPixel;
  const northward = difference(pointOf(eastNorthUp(place), 0, STEP * metresPerPixel, 0), place);
  // As it is seen: what lies deeper is nearer to the middle, in the same direction from it.
  const north = Math.atan2(dot(northward, cross(direction, up)), dot(northward, up));
  return { metresPerPixel, north };
}
