import { difference, dot, type Vector } from "@groma/georef";
import {
  alongRay,
  type CameraPose,
  headingAt,
  heightOf,
  type Lens,
  placeLookedAt,
  rayThrough,
  type ScreenPlace,
  upAt,
} from "../../camera/index.js";
import { beside, turnAbout, turned, turnOnto } from "./turning.js";

/** How a place is dragged: along the ground, at its height, or parallel to the picture, at its depth. */
export type PanWay = "ground" | "picture";

/** Sine of the least angle at which the ground is dragged; more flatly, or from below, a place is dragged in the picture. */
const LEAST_SINE = Math.sin((6 * Math.PI) / 180);
/** Cosine of the latitude from which on the heading is kept less and less: at the poles there is none. */
const POLAR = Math.cos((80 * Math.PI) / 180);

/** How a place is to be dragged from now on. */
export function panWay({ position }: CameraPose, place: Vector): PanWay {
  const away = difference(position, place);
  return dot(away, upAt(place)) > LEAST_SINE * Math.hypot(...away) ? "ground" : "picture";
}

/**
 * A camera moved so that a place of the earth comes under a place of the picture. Along the ground it keeps its height, its
 * tilt and, away from the poles, its heading. Where no ray goes to the ground, it goes to the ground ahead.
 */
export function panTo(pose: CameraPose, lens: Lens, place: Vector, at: ScreenPlace, way: PanWay): CameraPose {
  const ray = rayThrough(pose, lens, at);
  const depth = dot(difference(place, pose.position), pose.direction);
  if (way === "picture" || heightOf(pose.position) <= heightOf(place)) {
    if (depth <= 0) return pose;
    const across = dot(ray.direction, pose.direction);
    const shown = alongRay(ray, dot(difference(place, ray.origin), pose.direction) / across);
    return { ...pose, position: beside(pose.position, 1, difference(place, shown)) };
  }
  const looking = { ...pose, position: ray.origin, direction: ray.direction };
  return carried(pose, placeLookedAt(looking, heightOf(place)), place);
}

/**
 * A camera that stands to another place as one does to the place it has: as far away, at the same tilt, and in the same
 * heading except near the poles.
 */
export function carried(pose: CameraPose, from: Vector, to: Vector): CameraPose {
  const up = upAt(to);
  const turn = turnOnto(upAt(from), up);
  const moved = turned(pose, turn, beside(to, 1, turn(difference(pose.position, from))));
  const share = Math.min(1, (Math.hypot(up[0], up[1]) / POLAR) ** 2);
  const strayed = share * within(headingAt(moved, to) - headingAt(pose, from));
  const back = turnAbout(up, strayed);
  return turned(moved, back, beside(to, 1, back(difference(moved.position, to))));
}

/** An angle between -π and π. */
function within(angle: number): number {
  return Math.atan2(Math.sin(angle), Math.cos(angle));
}
