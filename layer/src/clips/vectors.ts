import type { Frame } from "@groma/georef";

export type Vector = readonly [number, number, number];

export function dot(a: ArrayLike<number>, b: ArrayLike<number>): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function difference(a: ArrayLike<number>, b: ArrayLike<number>): Vector {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function cross(a: ArrayLike<number>, b: ArrayLike<number>): Vector {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function unit(a: ArrayLike<number>): Vector {
  const length = Math.hypot(a[0], a[1], a[2]);
  return [a[0] / length, a[1] / length, a[2] / length];
}

/** A direction of ECEF in a frame. */
export function turnIn({ rotation: r }: Frame, x: number, y: number, z: number): Vector {
  return [r[0] * x + r[1] * y + r[2] * z, r[3] * x + r[4] * y + r[5] * z, r[6] * x + r[7] * y + r[8] * z];
}

/** A point of ECEF in a frame; the difference to its origin is formed first. */
export function pointIn(frame: Frame, x: number, y: number, z: number): Vector {
  const { origin } = frame;
  return turnIn(frame, x - origin[0], y - origin[1], z - origin[2]);
}

/** A point of a frame in ECEF. */
export function pointOf({ rotation: r, origin }: Frame, x: number, y: number, z: number): Vector {
  return [
    origin[0] + r[0] * x + r[3] * y + r[6] * z,
    origin[1] + r[1] * x + r[4] * y + r[7] * z,
    origin[2] + r[2] * x + r[5] * y + r[8] * z,
  ];
}
