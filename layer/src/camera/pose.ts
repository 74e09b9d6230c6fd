import { cross, difference, dot, eastNorthUp, turnIn, type Vector } from "@groma/georef";
import { heightOf, horizonBelow, meetSurface, type Ray, upAt } from "./surface.js";

/** Where a camera stands and how it is turned, ECEF. */
export interface CameraPose {
  /** Metres. */
  readonly position: Vector;
  /** Unit vectors. */
  readonly direction: Vector;
  readonly up: Vector;
}

/** What a camera looks at, and from which side. */
export interface Target {
  /** ECEF, metres. */
  readonly place: Vector;
  /** Azimuth in which the picture's upper edge lies, radians clockwise from north at the place. */
  readonly heading: number;
}

/**
 * Sine and cosine of the least angle below the horizon at which something is looked at, one in twenty: what is flatter
 * looks at nothing near, and the map would rush to the horizon and back.
 */
const LEAST_DIP = { sine: 1 / Math.hypot(1, 20), cosine: 20 / Math.hypot(1, 20) };
/** Metres by which a camera stands above a surface at least; one that does not looks at what is `BENEATH` it. */
const CLEARANCE = 0.01;
const BENEATH = 1;

/**
 * The place that a camera looks at: where the ray through the middle of its picture meets the surface of a height.
 * A ray flatter than one in twenty, or one that rises, is taken as one of that dip in the same direction; one that
 * passes the earth is taken to end at the horizon. So the place moves without a jump whatever the tilt.
 * @param height metres above WGS 84, of the ground or of what stands on it
 */
export function placeLookedAt(pose: CameraPose, height: number): Vector {
  const { position } = pose;
  const eye = heightOf(position);
  const surface = eye - height > CLEARANCE ? height : eye - BENEATH;
  const ray: Ray = { origin: position, direction: notTooFlat(pose) };
  const place = meetSurface(ray, surface) ?? horizonBelow(ray, surface);
  if (place) return place;
  // Straight up or from below the surface: what lies under the camera.
  const up = upAt(position);
  return [position[0] - up[0], position[1] - up[1], position[2] - up[2]];
}

function notTooFlat({ position, direction, up: top }: CameraPose): Vector {
  const up = upAt(position);
  const rise = dot(direction, up);
  if (rise <= -LEAST_DIP.sine) return direction;
  // Where the camera looks to the zenith, the picture's lower edge lies in the direction that it came from.
  const level = levelled(direction, up) ?? levelled([-top[0], -top[1], -top[2]], up);
  if (!level) return direction;
  const { sine, cosine } = LEAST_DIP;
  return [0, 1, 2].map((axis) => cosine * level[axis] - sine * up[axis]) as unknown as Vector;
}

/** The horizontal part of a direction, as a unit vector; undefined where it has none. */
function levelled(direction: Vector, up: Vector): Vector | undefined {
  const rise = dot(direction, up);
  const [x, y, z] = direction.map((value, axis) => value - rise * up[axis]);
  const length = Math.hypot(x, y, z);
  return length > 1e-6 ? [x / length, y / length, z / length] : undefined;
}

/**
 * The azimuth, at a place, of the upper edge of a camera's picture: that of the right edge less a quarter turn, which is
 * right for a camera that looks straight down as for any other.
 * @param place ECEF, metres
 */
export function headingAt({ direction, up }: CameraPose, place: Vector): number {
  const frame = eastNorthUp(place);
  const [east, north] = turnIn(frame, ...cross(direction, up));
  if (Math.hypot(east, north) > 1e-6) return Math.atan2(-north, east);
  // A camera on its side: its right edge is above or below.
  const [ahead, aside] = turnIn(frame, ...direction);
  return Math.atan2(ahead, aside);
}

/**
 * A camera that stands to another target as one does to the target it has: from the same side, at the same tilt, and
 * `scale` times as far away.
 */
export function moveCamera(pose: CameraPose, from: Target, to: Target, scale: number): CameraPose {
  const [before, after] = [axesOf(from), axesOf(to)];
  const carry = (vector: Vector): Vector => {
    const parts = before.map((axis) => dot(axis, vector));
    const [x, y, z] = [0, 1, 2].map((at) =>
      after.reduce((sum, axis, index) => sum + parts[index] * axis[at], 0),
    );
    return [x, y, z];
  };
  const [x, y, z] = carry(difference(pose.position, from.place));
  return {
    position: [to.place[0] + scale * x, to.place[1] + scale * y, to.place[2] + scale * z],
    direction: carry(pose.direction),
    up: carry(pose.up),
  };
}

/** Unit vectors in ECEF at a target: to the right of its heading, ahead, and up. */
function axesOf({ place, heading }: Target): readonly [Vector, Vector, Vector] {
  const { rotation } = eastNorthUp(place);
  const column = (at: number): Vector => [rotation[at], rotation[at + 1], rotation[at + 2]];
  const [east, north, up] = [column(0), column(3), column(6)];
  const [cosine, sine] = [Math.cos(heading), Math.sin(heading)];
  const mix = (a: number, b: number): Vector => [
    a * east[0] + b * north[0],
    a * east[1] + b * north[1],
    a * east[2] + b * north[2],
  ];
  return [mix(cosine, -sine), mix(sine, cosine), up];
}
