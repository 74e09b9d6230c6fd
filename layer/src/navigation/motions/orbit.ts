import { cross, difference, dot, type Vector } from "@groma/georef";
import { type CameraPose, upAt } from "../../camera/index.js";
import { beside, levelRight, turnAbout, turned } from "./turning.js";

/** How far a camera may be tilted: pitch of its direction above the horizon, radians. */
export interface PitchLimits {
  readonly least: number;
  readonly greatest: number;
}

/** From straight down to straight up. */
export const ALL_PITCHES: PitchLimits = { least: -Math.PI / 2, greatest: Math.PI / 2 };

/** Pitch of a camera above the horizon of a vertical, radians; beyond ±π/2 for one that is upside down. */
export function pitchOf(pose: CameraPose, up: Vector): number {
  const ahead = cross(up, levelRight(pose, up));
  return Math.atan2(dot(pose.direction, up), dot(pose.direction, ahead));
}

/**
 * A camera turned about the vertical through a place and tilted about a horizontal line through it: the place stays where
 * it is in the picture, and as far away. The place of the camera itself makes it look around.
 *
 * @param turn radians to the left, seen from above
 * @param tilt radians by which the camera looks further up, as far as the limits allow; a pitch beyond them may come back
 */
export function orbit(
  pose: CameraPose,
  pivot: Vector,
  turn: number,
  tilt: number,
  limits: PitchLimits = ALL_PITCHES,
): CameraPose {
  const up = upAt(pivot);
  const pitch = pitchOf(pose, up);
  const least = Math.min(limits.least, pitch) - pitch;
  const greatest = Math.max(limits.greatest, pitch) - pitch;
  const tilting = turnAbout(levelRight(pose, up), Math.min(greatest, Math.max(least, tilt)));
  const turning = turnAbout(up, turn);
  const away = turning(tilting(difference(pose.position, pivot)));
  return turned(pose, (vector) => turning(tilting(vector)), beside(pivot, 1, away));
}
