import { difference, dot, unit, type Vector } from "@groma/georef";
import { type CameraPose, upAt } from "../../camera/index.js";
import { beside, type Turn, turned, turnOnto } from "./turning.js";

/** Steps at most in which the vertical at the new place is found, and the change of it below which it is. */
const STEPS = 40;
const NEAR = 1e-12;
/** Sine of the angle at which a place may be seen at least by a camera that goes away and keeps its tilt. */
const LEAST_SINE = 0.3;

/**
 * A camera `scale` times as far from a place, which stays where it is in the picture.
 *
 * It keeps its tilt against its own vertical: what is approached from space is upright on arrival. With u the vertical, the
 * turn about the place takes u of the old place to u of the new one, which hangs on the turn; repeated, that settles, since
 * a place in sight is nearer than the centre of the earth. A camera that goes away stops doing so before the place
 * would come to lie at the horizon.
 */
export function zoomAbout(pose: CameraPose, place: Vector, scale: number): CameraPose {
  const away = difference(pose.position, place);
  const vertical = upAt(pose.position);
  let turn: Turn = (vector) => vector;
  let position = beside(place, scale, away);
  const straight = turned(pose, turn, position);
  let before = vertical;
  for (let step = 0; step < STEPS; step++) {
    const up = upAt(position);
    turn = turnOnto(vertical, up);
    position = beside(place, scale, turn(away));
    if (Math.hypot(...difference(up, before)) < NEAR) break;
    before = up;
  }
  const sine = dot(unit(difference(position, place)), upAt(place));
  return scale > 1 && !(sine >= LEAST_SINE) ? straight : turned(pose, turn, position);
}
