import { cross, difference, dot, type Vector } from "@groma/georef";
import type { Vertex } from "../vertex/vertex.js";
import { acrossError, lengthTerm } from "../worth/near-noise.js";
import type { WorthOptions } from "../worth/point-errors.js";
import { type Quantity, quantity } from "../worth/quantity.js";
import { directionOf } from "./direction.js";
import { azimuthTerm, isOneFoot, joined, type Line, lineOf, scaled } from "./line.js";
import { coincident } from "./refusals.js";

/** The angle between two lines that meet. */
export interface Angle {
  /** In the plane of both lines, 0 … π. */
  readonly space: Quantity<"rad">;
  /** Between their azimuths, clockwise from the first to the second, 0 … 2π; undefined where one is vertical. */
  readonly horizontal?: Quantity<"rad"> | undefined;
}

/**
 * The angle at a vertex between the directions to two others.
 * @throws MeasureError MEASURE_COINCIDENT where one of them stands on the vertex
 */
export function measureAngle(a: Vertex, apex: Vertex, b: Vertex, options: WorthOptions = {}): Angle {
  const [toA, toB] = [lineOf(apex, a), lineOf(apex, b)];
  if (toA.space === 0 || toB.space === 0) {
    throw coincident("angle", "one of its sides has no length");
  }
  const [u, v] = [difference(a.ecef, apex.ecef), difference(b.ecef, apex.ecef)];
  // Right for the smallest angles too, where the arc cosine has lost half its digits.
  const value = Math.atan2(Math.hypot(...cross(u, v)), dot(u, v));
  const [ofA, ofB] = [away(u, v), away(v, u)];
  const ofApex: Vector = [-ofA[0] - ofB[0], -ofA[1] - ofB[1], -ofA[2] - ofB[2]];
  const gradients = [
    { vertex: a, gradient: ofA },
    { vertex: apex, gradient: ofApex },
    { vertex: b, gradient: ofB },
  ];
  // Straight on, or back: what the angle lacks to that is the length of what is across, either way.
  const axis = scaled(u, 1 / Math.hypot(...u));
  const sideways = gradients.map(({ vertex, gradient }) => ({ vertex, gradient: cross(axis, gradient) }));
  const bend = Math.min(value, Math.PI - value);
  const { sensitivities, across } = lengthTerm(bend, gradients, () => [gradients, sideways], options);
  return {
    space: quantity(value, "rad", sensitivities, { ...options, own: acrossError(across) }),
    ...(!isOneFoot(toA) && !isOneFoot(toB) && { horizontal: betweenAzimuths(toA, toB, options) }),
  };
}

function betweenAzimuths(toA: Line, toB: Line, options: WorthOptions): Quantity<"rad"> {
  const turned = toB.geodesic.azimuthFrom - toA.geodesic.azimuthFrom;
  const [ofA, ofB] = [azimuthTerm(toA, "a", options), azimuthTerm(toB, "a", options)];
  const away = ofA?.map(({ vertex, gradient }) => ({ vertex, gradient: scaled(gradient, -1) }));
  const turning = away && ofB && joined([[away], [ofB]])[0];
  return directionOf(turned < 0 ? turned + 2 * Math.PI : turned, turning, options);
}

/** How the angle from v grows with the end of u: across u, away from v, over its length; any way where they are in line. */
function away(u: Vector, v: Vector): Vector {
  const length = Math.hypot(...u);
  const along = dot(u, v) / length ** 2;
  const across: Vector = [along * u[0] - v[0], along * u[1] - v[1], along * u[2] - v[2]];
  const size = Math.hypot(...across);
  if (size > 1e-9 * Math.hypot(...v)) return scaled(across, 1 / (size * length));
  const least = [0, 1, 2].reduce((best, axis) => (Math.abs(u[axis]) < Math.abs(u[best]) ? axis : best), 0);
  const side = cross(u, [least === 0 ? 1 : 0, least === 1 ? 1 : 0, least === 2 ? 1 : 0]);
  return scaled(side, 1 / (Math.hypot(...side) * length));
}
