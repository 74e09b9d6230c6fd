import { type Geodesic, geodesicBetween, radiusAlong, type Vector } from "@groma/georef";
import { axesAt, combined } from "../vertex/axes.js";
import { recordKey, type Vertex } from "../vertex/vertex.js";
import { directionTerm, lengthTerm, type Term } from "../worth/near-noise.js";
import type { QuantityOptions, Sensitivity } from "../worth/quantity.js";

/** Two vertices with what several values of theirs need. */
export interface Line {
  readonly a: Vertex;
  readonly b: Vertex;
  /** Metres through space. */
  readonly space: number;
  /** Below them, on the ellipsoid of WGS 84. */
  readonly geodesic: Geodesic;
}

/** The straight line and the geodesic between two vertices. */
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

/** Derivatives of the three components of the way through space. */
export function spaceComponents(line: Line): Sensitivity[][] {
  return AXES.map((axis) => ends(line, scaled(axis, -1), axis));
}

/** Derivatives of the length through space; of points as near as their noise those of all three components. */
export function spaceTerm(line: Line, options: QuantityOptions): Term {
  const { a, b, space } = line;
  if (space < NO_LENGTH) return { sensitivities: spaceComponents(line), across: 0 };
  const along: Vector = [
    (b.ecef[0] - a.ecef[0]) / space,
    (b.ecef[1] - a.ecef[1]) / space,
    (b.ecef[2] - a.ecef[2]) / space,
  ];
  return lengthTerm(space, ends(line, scaled(along, -1), along), () => spaceComponents(line), options);
}

/** Derivatives of the two level components, east and north. */
export function levelComponents(line: Line, factor = 1): Sensitivity[][] {
  const [atA, atB] = [axesAt(line.a), axesAt(line.b)];
  return [
    ends(line, scaled(atA.east, -factor), scaled(atB.east, factor)),
    ends(line, scaled(atA.north, -factor), scaled(atB.north, factor)),
  ];
}

/**
 * Derivatives of the length on the ellipsoid: along the geodesic at each end (its height, some 1e-5 of the radius, is
 * passed over).
 */
export function levelTerm(line: Line, options: QuantityOptions, factor = 1): Term {
  const { a, b, geodesic } = line;
  if (geodesic.distance < NO_LENGTH) return { sensitivities: levelComponents(line, factor), across: 0 };
  const along = (vertex: Vertex, azimuth: number, sign: number) =>
    combined(axesAt(vertex), sign * Math.sin(azimuth), sign * Math.cos(azimuth), 0);
  const both = ends(line, along(a, geodesic.azimuthFrom, -factor), along(b, geodesic.azimuthTo, factor));
  return lengthTerm(factor * geodesic.distance, both, () => levelComponents(line, factor), options);
}

/** Derivatives of the difference of heights. */
export function verticalSensitivity(line: Line): Sensitivity[][] {
  return [ends(line, scaled(axesAt(line.a).up, -1), axesAt(line.b).up)];
}

const EARTH_RADIUS = 6371008.8;

/**
 * Derivatives of the azimuth at one end, undefined where it may be any: a motion across the line over the reduced length, which is that of a sphere
 * here; a metre at the least, where the line leads to the antipodes and any direction will do.
 */
export function azimuthTerm(
  line: Line,
  at: "a" | "b",
  options: QuantityOptions,
): readonly Sensitivity[] | undefined {
  const { a, b, geodesic } = line;
  const angle = geodesic.distance / EARTH_RADIUS;
  const reduced = Math.max(Math.abs(Math.sin(angle)) * EARTH_RADIUS, Number.MIN_VALUE);
  const across = (vertex: Vertex, azimuth: number, factor: number): Vector =>
    combined(axesAt(vertex), Math.cos(azimuth) * factor, -Math.sin(azimuth) * factor, 0);
  // The other end moves the azimuth by 1 / m12, its own end by M / m12, with M the geodesic scale, cos on a sphere.
  const [ofA, ofB] = at === "a" ? [-Math.cos(angle), 1] : [-1, Math.cos(angle)];
  const turning = ends(
    line,
    across(a, geodesic.azimuthFrom, ofA / reduced),
    across(b, geodesic.azimuthTo, ofB / reduced),
  );
  return directionTerm(reduced, turning, () => levelComponents(line), options);
}

/** Whether two places have no direction from one to the other on the ellipsoid. */
export function isOneFoot({ geodesic }: Line): boolean {
  return geodesic.distance < NO_LENGTH;
}

/** A vector times a factor. */
export function scaled([x, y, z]: Vector, factor: number): Vector {
  return [x * factor, y * factor, z * factor];
}

/** Derivatives of a sum: those of its terms by vertex, and lists of their own where a term has no direction. */
export function joined(terms: readonly (readonly (readonly Sensitivity[])[])[]): (readonly Sensitivity[])[] {
  const whole = new Map<unknown, { readonly vertex: Vertex; readonly gradient: Vector }>();
  const apart: (readonly Sensitivity[])[] = [];
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

/** Of several lengths the sum: derivatives, and what noise across each of them adds to all. */
export function summed(terms: readonly Term[]): Term {
  return {
    sensitivities: joined(terms.map(({ sensitivities }) => sensitivities)),
    across: terms.reduce((sum, { across }) => sum + across, 0),
  };
}
