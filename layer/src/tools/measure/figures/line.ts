import { type Geodesic, geodesicBetween, radiusAlong, type Vector } from "@groma/georef";
import { axesAt, combined } from "../vertex/axes.js";
import { recordKey, type Vertex } from "../vertex/vertex.js";
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

const EARTH_RADIUS = 6371008.8;

/**
 * Derivatives of the azimuth at one end: a motion across the line over the reduced length, which is that of a sphere
 * here; a metre at the least, where the line leads to the antipodes and any direction will do.
 */
export function azimuthSensitivity(line: Line, at: "a" | "b"): Sensitivity[][] {
  const { a, b, geodesic } = line;
  const angle = geodesic.distance / EARTH_RADIUS;
  const reduced = Math.max(Math.abs(Math.sin(angle)) * EARTH_RADIUS, Number.MIN_VALUE);
  const across = (vertex: Vertex, azimuth: number, factor: number): Vector =>
    combined(axesAt(vertex), Math.cos(azimuth) * factor, -Math.sin(azimuth) * factor, 0);
  // The other end moves the azimuth by 1 / m12, its own end by M / m12, with M the geodesic scale, cos on a sphere.
  const [ofA, ofB] = at === "a" ? [-Math.cos(angle), 1] : [-1, Math.cos(angle)];
  return [
    ends(line, across(a, geodesic.azimuthFrom, ofA / reduced), across(b, geodesic.azimuthTo, ofB / reduced)),
  ];
}

/** Whether two places have no direction from one to the other on the ellipsoid. */
export function isOneFoot({ geodesic }: Line): boolean {
  return geodesic.distance < NO_LENGTH;
}

export function scaled([x, y, z]: Vector, factor: number): Vector {
  return [x * factor, y * factor, z * factor];
}

/** Derivatives of a sum: those of its terms by vertex, and lists of their own where a term has no direction. */
export function joined(terms: readonly Sensitivity[][][]): Sensitivity[][] {
  const whole = new Map<unknown, { readonly vertex: Vertex; readonly gradient: Vector }>();
  const apart: Sensitivity[][] = [];
  for (const lists of terms) {
    if (lists.length > 1) {
      apart.push(...lists);
      continue;
    }
    for (const { vertex, gradient } of lists[0]) {
      const key = recordKey(vertex);
      const [x, y, z] = whole.get(key)?.gradient ?? [0, 0, 0];
      whole.set(key, { vertex, gradient: [x + gradient[0], y + gradient[1], z + gradient[2]] });
    }
  }
  return [[...whole.values()], ...apart];
}
