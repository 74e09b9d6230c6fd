import { type Link, premultiply } from "./link.js";

/** Longitude and latitude, radians. */
export type Place = readonly [longitude: number, latitude: number];

/** Below this distance from a pole, radians (0.6 mm), derivatives are those of that distance: at the pole they have no limit. */
const NEAR_POLE = 1e-10;

/** Rows of the rotation of normals that brings a place to longitude 0, latitude 0. */
function rotationOf([longitude, latitude]: Place): Float64Array {
  const [sinLongitude, cosLongitude] = [Math.sin(longitude), Math.cos(longitude)];
  const [sinLatitude, cosLatitude] = [Math.sin(latitude), Math.cos(latitude)];
  return Float64Array.of(
    ...[cosLatitude * cosLongitude, cosLatitude * sinLongitude, sinLatitude],
    ...[-sinLongitude, cosLongitude, 0],
    ...[-sinLatitude * cosLongitude, -sinLatitude * sinLongitude, cosLatitude],
  );
}

/**
 * Longitude, latitude pairs (radians) on the sphere of normals as it is turned to a place, in the place of those from
 * Greenwich and the equator; what is not finite stays so. Angles between places are the same.
 */
export function turnedPlaces(places: Float64Array, centre: Place): Float64Array {
  const rotation = rotationOf(centre);
  const out = new Float64Array(places.length);
  for (let at = 0; at < places.length; at += 2) {
    const cosine = Math.cos(places[at + 1]);
    const normal = [cosine * Math.cos(places[at]), cosine * Math.sin(places[at]), Math.sin(places[at + 1])];
    const [x, y, z] = [0, 3, 6].map(
      (row) => rotation[row] * normal[0] + rotation[row + 1] * normal[1] + rotation[row + 2] * normal[2],
    );
    out[at] = Math.atan2(y, x);
    out[at + 1] = Math.atan2(z, Math.hypot(x, y));
  }
  return out;
}

/** Compiles the way back: (longitude, latitude of the turned sphere, z) → (longitude, latitude, z). */
export function turnBackLink(centre: Place): Link {
  const r = rotationOf(centre);
  const own = new Float64Array(9);
  own[8] = 1;
  /** Component of a vector of the turned sphere along an axis of the earth: the transposed rotation. */
  const along = (axis: number, x: number, y: number, z: number) =>
    r[axis] * x + r[3 + axis] * y + r[6 + axis] * z;

  const apply = (state: Float64Array) => {
    const cosine = Math.cos(state[1]);
    const [x, y, z] = [cosine * Math.cos(state[0]), cosine * Math.sin(state[0]), Math.sin(state[1])];
    const [east, ninety, north] = [along(0, x, y, z), along(1, x, y, z), along(2, x, y, z)];
    state[0] = Math.atan2(ninety, east);
    state[1] = Math.atan2(north, Math.hypot(east, ninety));
  };

  return {
    apply,
    differentiate(state, jacobian) {
      const [sinA, cosA] = [Math.sin(state[0]), Math.cos(state[0])];
      const [sinB, cosB] = [Math.sin(state[1]), Math.cos(state[1])];
      const normal = [0, 1, 2].map((axis) => along(axis, cosB * cosA, cosB * sinA, sinB));
      const byA = [0, 1, 2].map((axis) => along(axis, -cosB * sinA, cosB * cosA, 0));
      const byB = [0, 1, 2].map((axis) => along(axis, -sinB * cosA, -sinB * sinA, cosB));
      const near = Math.hypot(normal[0], normal[1]) < NEAR_POLE;
      const [x, y] = near ? [NEAR_POLE, 0] : [normal[0], normal[1]];
      const square = x * x + y * y;
      const level = Math.sqrt(square);
      for (const [column, by] of [byA, byB].entries()) {
        own[column] = (x * by[1] - y * by[0]) / square;
        own[3 + column] = level * by[2] - (normal[2] * (x * by[0] + y * by[1])) / level;
      }
      premultiply(own, jacobian);
      if (near) {
        state[0] = 0;
        state[1] = Math.sign(normal[2]) * (Math.PI / 2 - NEAR_POLE);
      } else apply(state);
    },
  };
}
