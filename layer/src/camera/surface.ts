import { dot, ecefToGeodetic, type Vector, WGS84 } from "@groma/georef";

/** A half-line in ECEF, metres. */
export interface Ray {
  readonly origin: Vector;
  /** A unit vector. */
  readonly direction: Vector;
}

/** Steps of Newton's method from an ellipsoid with longer axes to the surface of a height. */
const STEPS = 3;
/** A ray that meets the surface more flatly (sine of the angle) is left where the ellipsoid is. */
const FLAT = 1e-3;

const geodetic = new Float64Array(3);

/** Height above WGS 84 of a place of ECEF, metres. */
export function heightOf([x, y, z]: Vector): number {
  ecefToGeodetic(x, y, z, geodetic);
  return geodetic[2];
}

/** The normal of WGS 84 through a place of ECEF. */
export function upAt([x, y, z]: Vector): Vector {
  ecefToGeodetic(x, y, z, geodetic);
  const [longitude, latitude] = geodetic;
  const cosine = Math.cos(latitude);
  return [cosine * Math.cos(longitude), cosine * Math.sin(longitude), Math.sin(latitude)];
}

/** A place on a ray. @param distance metres from its origin */
export function alongRay({ origin, direction }: Ray, distance: number): Vector {
  return [
    origin[0] + distance * direction[0],
    origin[1] + distance * direction[1],
    origin[2] + distance * direction[2],
  ];
}

/**
 * Where a ray that comes from above first meets the places of one height above WGS 84.
 *
 * The quadratic of the ellipsoid whose axes are longer by the height gives a place that is off by some 1e-5 of the
 * height; Newton's method along the ray takes that away.
 *
 * @param height metres
 * @returns undefined where it passes by, or begins below
 */
export function meetSurface(ray: Ray, height: number): Vector | undefined {
  const { origin, direction } = scaled(ray, height);
  const a = dot(direction, direction);
  const b = dot(origin, direction);
  const c = dot(origin, origin) - 1;
  const discriminant = b * b - a * c;
  if (c < 0 || b >= 0 || discriminant < 0) return undefined;
  // The nearer root, without a difference of numbers of one size.
  let distance = c / (-b + Math.sqrt(discriminant));
  for (let step = 0; step < STEPS; step++) {
    const place = alongRay(ray, distance);
    const slope = dot(ray.direction, upAt(place));
    if (slope > -FLAT) break;
    distance += (height - heightOf(place)) / slope;
  }
  return alongRay(ray, distance);
}

/**
 * The place of the horizon that a ray passes above: in the plane of the ray and the centre of the earth, where a line
 * from the ray's origin touches the surface of a height.
 *
 * In coordinates that make the ellipsoid a unit sphere, q the origin and w the unit vector perpendicular to it on the
 * ray's side, the line touches at q̂ cos α + w sin α, cos α = 1 / |q|.
 *
 * @returns undefined for a ray along the vertical, which has no side, and one that begins below
 */
export function horizonBelow(ray: Ray, height: number): Vector | undefined {
  const { origin, direction } = scaled(ray, height);
  const length = Math.hypot(...origin);
  if (length < 1) return undefined;
  const along = dot(direction, origin) / (length * length);
  const side = direction.map((value, axis) => value - along * origin[axis]);
  const width = Math.hypot(...side);
  if (!(width > 1e-12 * Math.hypot(...direction))) return undefined;
  const cosine = 1 / length;
  const sine = Math.sqrt(1 - cosine * cosine);
  const axes = axesOf(height);
  const [x, y, z] = axes.map(
    (axis, at) => axis * ((cosine * origin[at]) / length + (sine * side[at]) / width),
  );
  return [x, y, z];
}

/**
 * The place of the limb that a ray of a picture without perspective passes by: of those that touch the surface of a
 * height, in the plane of the ray and the centre of the earth.
 *
 * In coordinates that make the ellipsoid a unit sphere it is the part of the origin perpendicular to the direction, of
 * length 1.
 *
 * @returns undefined for a ray whose line meets the surface
 */
export function limbBeside(ray: Ray, height: number): Vector | undefined {
  const { origin, direction } = scaled(ray, height);
  const along = dot(origin, direction) / dot(direction, direction);
  const aside = origin.map((value, axis) => value - along * direction[axis]);
  const length = Math.hypot(...aside);
  if (length < 1) return undefined;
  const [x, y, z] = axesOf(height).map((axis, at) => (axis * aside[at]) / length);
  return [x, y, z];
}

/** The ray in coordinates in which the ellipsoid of a height is a unit sphere. */
function scaled({ origin, direction }: Ray, height: number): Ray {
  const [x, y, z] = axesOf(height);
  return {
    origin: [origin[0] / x, origin[1] / y, origin[2] / z],
    direction: [direction[0] / x, direction[1] / y, direction[2] / z],
  };
}

function axesOf(height: number): Vector {
  const { a, f } = WGS84;
  return [a + height, a + height, a * (1 - f) + height];
}
