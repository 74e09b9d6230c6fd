import { cross, dot, unit, type Vector } from "@groma/georef";
import type { CameraPose } from "../../camera/index.js";

/** A rotation about the origin. */
export type Turn = (vector: Vector) => Vector;

/** A vector turned about a unit axis, right-handed (Rodrigues' formula). @param angle radians */
export function turnAbout(axis: Vector, angle: number): Turn {
  const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
  return (vector) => {
    const aside = cross(axis, vector);
    const along = (1 - cosine) * dot(axis, vector);
    const at = (i: number) => cosine * vector[i] + sine * aside[i] + along * axis[i];
    return [at(0), at(1), at(2)];
  };
}

/**
 * The least rotation that takes one unit vector to another. Carried along a way it turns nothing about the vertical, so that
 * there is no place, poles included, where it jumps.
 */
export function turnOnto(from: Vector, to: Vector): Turn {
  const cosine = dot(from, to);
  const axis = cross(from, to);
  // Opposite ends of the earth: no move of a frame leads there.
  if (cosine < -0.999_999) return (vector) => vector;
  return (vector) => {
    const aside = cross(axis, vector);
    const along = dot(axis, vector) / (1 + cosine);
    const at = (i: number) => cosine * vector[i] + aside[i] + along * axis[i];
    return [at(0), at(1), at(2)];
  };
}

/** A camera somewhere, turned from how it stands; its axes stay at right angles however often that is done. */
export function turned({ direction, up }: CameraPose, turn: Turn, position: Vector): CameraPose {
  const ahead = unit(turn(direction));
  const top = turn(up);
  const lean = dot(top, ahead);
  return {
    position,
    direction: ahead,
    up: unit([top[0] - lean * ahead[0], top[1] - lean * ahead[1], top[2] - lean * ahead[2]]),
  };
}

/** A place that lies `scale` times a vector away from another one. */
export function beside(place: Vector, scale: number, vector: Vector): Vector {
  return [place[0] + scale * vector[0], place[1] + scale * vector[1], place[2] + scale * vector[2]];
}

/** The horizontal direction to a camera's right, a unit vector; of one on its side, its own right. @param up unit vector */
export function levelRight({ direction, up: top }: CameraPose, up: Vector): Vector {
  const right = cross(direction, top);
  const level = beside(right, -dot(right, up), up);
  return Math.hypot(...level) > 1e-6 ? unit(level) : right;
}
