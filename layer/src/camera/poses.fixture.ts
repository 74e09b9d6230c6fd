import { cross, difference, eastNorthUp, geodeticToEcef, type Vector } from "@groma/georef";
import fc from "fast-check";
import type { CameraPose } from "./pose.js";

export const DEGREE = Math.PI / 180;

export function ecef(longitudeDegrees: number, latitudeDegrees: number, height = 0): Vector {
  const out = new Float64Array(3);
  geodeticToEcef(longitudeDegrees * DEGREE, latitudeDegrees * DEGREE, height, out);
  return [out[0], out[1], out[2]];
}

/** A camera by its place and angles in degrees; pitch from the horizon, roll to the right. */
export function cameraAt(position: Vector, heading: number, pitch: number, roll = 0): CameraPose {
  const { rotation: r } = eastNorthUp(position);
  const out = (x: number, y: number, z: number): Vector => [
    r[0] * x + r[3] * y + r[6] * z,
    r[1] * x + r[4] * y + r[7] * z,
    r[2] * x + r[5] * y + r[8] * z,
  ];
  const [h, p, t] = [heading * DEGREE, pitch * DEGREE, roll * DEGREE];
  const direction = out(Math.cos(p) * Math.sin(h), Math.cos(p) * Math.cos(h), Math.sin(p));
  const right = out(Math.cos(h), -Math.sin(h), 0);
  const up = cross(right, direction);
  const mixed = [0, 1, 2].map((axis) => Math.cos(t) * up[axis] + Math.sin(t) * right[axis]);
  return { position, direction, up: mixed as unknown as Vector };
}

export const distance = (a: Vector, b: Vector) => Math.hypot(...difference(a, b));
export const number = (min: number, max: number) => fc.double({ min, max, noNaN: true });
/** Everywhere, with the poles and 180° among it. */
export const longitude = fc.oneof(number(-180, 180), fc.constantFrom(-180, 180, 179.9999999, 0));
export const latitude = fc.oneof(number(-90, 90), fc.constantFrom(-90, 90, 89.9999999));
export const span = number(0, 7).map((power) => 10 ** power);
