import {
  cross,
  difference,
  dot,
  ecefToGeodetic,
  geodesicBetween,
  geodesicFrom,
  geodeticToEcef,
  unit,
  type Vector,
} from "@groma/georef";
import { STRIDE, type Steps } from "./steps.js";
import type { Place } from "./volume.js";

/**
 * Longest piece of a geodesic that is taken as an arc in a plane through the earth's centre, metres. The two part by
 * e² sin 2φ / 2 · L² / 8R at most, 0.07 mm here (measured against GeographicLib over latitudes and azimuths).
 */
const LONGEST_PIECE = 1000;

/** Distance that a piece of a line straight in source coordinates may lie from such an arc, metres. */
const STRAIGHTNESS = 5e-5;

/** A ring on the ground as short pieces: vertices in turn, the first not repeated. */
export interface Ring {
  readonly count: number;
  /** ECEF of each vertex, metres: on the ellipsoid, or at source height 0. */
  readonly feet: Float64Array;
  /** Unit vector of the vertical through each. */
  readonly ups: Float64Array;
}

/**
 * A ring of geodesics of WGS 84, verticals along its normals.
 * @param corners longitude and latitude of each corner, radians
 */
export function* geodesicRing(corners: readonly (readonly [number, number])[]): Steps<Ring> {
  const feet: number[] = [];
  const ups: number[] = [];
  const add = (foot: Vector, longitude: number, latitude: number) => {
    feet.push(...foot);
    ups.push(...normalAt(longitude, latitude));
  };
  let end = onEllipsoid(...corners[0]);
  for (const [index, [longitude, latitude]] of corners.entries()) {
    const next = corners[(index + 1) % corners.length];
    const start = end;
    end = onEllipsoid(...next);
    add(start, longitude, latitude);
    // A geodesic is longer than its chord by less than a hundredth of a millimetre here.
    const whole = Math.hypot(...difference(end, start)) < LONGEST_PIECE - 1;
    if (!whole) {
      const { distance, azimuthFrom } = geodesicBetween(longitude, latitude, next[0], next[1]);
      const pieces = Math.ceil(distance / LONGEST_PIECE);
      for (let piece = 1; piece < pieces; piece++) {
        const at = geodesicFrom(longitude, latitude, azimuthFrom, (distance * piece) / pieces);
        add(onEllipsoid(at.longitude, at.latitude), at.longitude, at.latitude);
        if (piece % STRIDE === 0) yield;
      }
    }
    if (index % STRIDE === STRIDE - 1) yield;
  }
  return { count: feet.length / 3, feet: Float64Array.from(feet), ups: Float64Array.from(ups) };
}

/**
 * A ring straight in source coordinates, verticals along source z.
 * @param corners source x and y of each corner
 */
export function* sourceRing(corners: readonly (readonly [number, number])[], place: Place): Steps<Ring> {
  const feet: number[] = [];
  const ups: number[] = [];
  const add = (x: number, y: number) => {
    feet.push(...placed(place, x, y, 0));
    ups.push(...upAt(place, x, y));
  };
  /** Adds what lies between two points: nothing where the arc is straight enough. */
  function* between(ax: number, ay: number, bx: number, by: number, left: number): Steps<void> {
    const [mx, my] = [(ax + bx) / 2, (ay + by) / 2];
    const [a, m, b] = [placed(place, ax, ay, 0), placed(place, mx, my, 0), placed(place, bx, by, 0)];
    // Of differences: the product of two places themselves is no finer than a millimetre over 10 m.
    const along = difference(b, a);
    const plane = cross(a, along);
    const aside = Math.abs(dot(plane, difference(m, a))) / Math.hypot(...plane);
    const length = Math.hypot(...along);
    if (left === 0 || !(aside > STRAIGHTNESS || length > 4 * LONGEST_PIECE)) return;
    yield* between(ax, ay, mx, my, left - 1);
    add(mx, my);
    yield;
    yield* between(mx, my, bx, by, left - 1);
  }
  for (const [index, [x, y]] of corners.entries()) {
    const next = corners[(index + 1) % corners.length];
    add(x, y);
    yield* between(x, y, next[0], next[1], 14);
    if (index % STRIDE === STRIDE - 1) yield;
  }
  return { count: feet.length / 3, feet: Float64Array.from(feet), ups: Float64Array.from(ups) };
}

/** Farthest that a ring of geodesics may reach from its middle, radians: on half the earth no side would be its inside. */
export const FARTHEST = (85 * Math.PI) / 180;

/**
 * Middle of the corners of a ring of geodesics, as a unit vector, and the cosine of the angle to the farthest of them:
 * NaN where they have no middle. Within less than half the earth no geodesic reaches farther than both its ends.
 * @param corners longitude and latitude of each corner, radians
 */
export function capOf(corners: readonly (readonly [number, number])[]): {
  readonly middle: Vector;
  readonly cosine: number;
} {
  const sum = [0, 0, 0];
  for (const corner of corners) {
    const direction = unit(onEllipsoid(...corner));
    for (let axis = 0; axis < 3; axis++) sum[axis] += direction[axis];
  }
  const middle = unit(sum);
  let cosine = 1;
  for (const corner of corners) cosine = Math.min(cosine, dot(middle, unit(onEllipsoid(...corner))));
  return { middle, cosine };
}

function onEllipsoid(longitude: number, latitude: number): Vector {
  const foot = new Float64Array(3);
  geodeticToEcef(longitude, latitude, 0, foot);
  return [foot[0], foot[1], foot[2]];
}

/** Normal of the ellipsoid: the direction of the vertical. */
export function normalAt(longitude: number, latitude: number): Vector {
  const fromAxis = Math.cos(latitude);
  return [fromAxis * Math.cos(longitude), fromAxis * Math.sin(longitude), Math.sin(latitude)];
}

/** Foot of a point on the ellipsoid of WGS 84, and its height above, metres. */
export function footOf(x: number, y: number, z: number): { readonly foot: Vector; readonly height: number } {
  const geodetic = new Float64Array(3);
  ecefToGeodetic(x, y, z, geodetic);
  const foot = new Float64Array(3);
  geodeticToEcef(geodetic[0], geodetic[1], 0, foot);
  return { foot: [foot[0], foot[1], foot[2]], height: geodetic[2] };
}

/** ECEF of source coordinates. */
export function placed(place: Place, x: number, y: number, z: number): Vector {
  const [a, b, c] = place(x, y, z, new Float64Array(3));
  return [a, b, c];
}

/** Direction in which source z grows, unit vector. */
export function upAt(place: Place, x: number, y: number): Vector {
  // The map is linear in z: a long step loses no digits.
  const low = placed(place, x, y, 0);
  const high = placed(place, x, y, 1000);
  const step = [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
  const length = Math.hypot(...step);
  return [step[0] / length, step[1] / length, step[2] / length];
}
