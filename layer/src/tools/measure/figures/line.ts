import { type Geodesic, geodesicBetween, radiusAlong, type Vector } from "@groma/georef";
import { axesAt, combined } from "../vertex/axes.js";
import type { Vertex } from "../vertex/vertex.js";
import type { Sensitivity } from "../worth/quantity.js";

/** Two vertices with what several values of theirs need. */
export interface Line {
  readonly a: Vertex;
  readonly b: Vertex;
  /** Metres through space. */
  readonly space: number;
  /** Below them, on the ellipsoid of WGS 84. */
  readonly geodesic: Geodesic;
}

export function lineOf(a: Vertex, b: Vertex): Line {
  const [dx, dy, dz] = [b.ecef[0] - a.ecef[0], b.ecef[1] - a.ecef[1], b.ecef[2] - a.ecef[2]];
  const geodesic = geodesicBetween(a.longitude, a.latitude, b.longitude, b.latitude);
  return { a, b, space: Math.hypot(dx, dy, dz), geodesic };
}

/**
 * Length at the mean height of both ends over length on the ellipsoid, by the curvature in the line's direction; for lines
 * of a tenth of the radius and more, whose curvature changes on the way, right to 1e-3 of the part that the height adds.
 */
export function raised({ a, b, geodesic: { azimuthFrom, azimuthTo } }: Line): number {
  const curvature = (1 / radiusAlong(a.latitude, azimuthFrom) + 1 / radiusAlong(b.latitude, azimuthTo)) / 2;
  return 1 + ((a.height + b.height) / 2) * curvature;
}

/** Derivatives of a value by the motion of both ends. */
export function ends({ a, b }: Line, ofA: Vector, ofB: Vector): Sensitivity[] {
  return [
    { vertex: a, gradient: ofA },
    { vertex: b, gradient: ofB },
  ];
}

const AXES: readonly Vector[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

/** Lengths below this have no direction, metres: rounding of ECEF is as large. */
const NO_LENGTH = 1e-8;

/** Derivatives of the length through space; of points in one place those of all three components. */
export function spaceSensitivity(line: Line): Sensitivity[][] {
  const { a, b, space } = line;
  if (space < NO_LENGTH) return AXES.map((axis) => ends(line, scaled(axis, -1), axis));
  const along: Vector = [
    (b.ecef[0] - a.ecef[0]) / space,
    (b.ecef[1] - a.ecef[1]) / space,
    (b.ecef[2] - a.ecef[2]) / space,
  ];
  return [ends(line, scaled(along, -1), along)];
}

/**
 * Derivatives of the length on the ellipsoid: along the geodesic at each end (its height, some 1e-5 of the radius, is
 * passed over).
 */
export function levelSensitivity(line: Line, factor = 1): Sensitivity[][] {
  const { a, b, geodesic } = line;
  const [atA, atB] = [axesAt(a), axesAt(b)];
  if (geodesic.distance < NO_LENGTH) {
    const east = ends(line, scaled(atA.east, -factor), scaled(atB.east, factor));
    return [east, ends(line, scaled(atA.north, -factor), scaled(atB.north, factor))];
  }
  const along = (axes: typeof atA, azimuth: number, sign: number) =>
    combined(axes, sign * Math.sin(azimuth), sign * Math.cos(azimuth), 0);
  return [ends(line, along(atA, geodesic.azimuthFrom, -factor), along(atB, geodesic.azimuthTo, factor))];
}

/** Derivatives of the difference of heights. */
export function verticalSensitivity(line: Line): Sensitivity[][] {
  return [ends(line, scaled(axesAt(line.a).up, -1), axesAt(line.b).up)];
}

/** Whether two places have no direction from one to the other on the ellipsoid. */
export function isOneFoot({ geodesic }: Line): boolean {
  return geodesic.distance < NO_LENGTH;
}

export function scaled([x, y, z]: Vector, factor: number): Vector {
  return [x * factor, y * factor, z * factor];
}
