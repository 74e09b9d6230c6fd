import { type Ellipsoid, WGS84 } from "../ellipsoid/ellipsoid.js";
import { geodeticToEcef } from "../ellipsoid/geodetic-to-ecef.js";
import { requireKind } from "../errors/arguments.js";
import { degrees, solverOf } from "./geographiclib.js";

/** A polygon on the ellipsoid whose edges are geodesics. */
export interface GeodesicPolygon {
  /** Metres, from the last vertex back to the first included. */
  readonly perimeter: number;
  /**
   * Square metres on the ellipsoid, positive for vertices that run counter-clockwise seen from above. Of the two sides
   * of a ring the smaller counts, so that a ring around a pole holds the pole; loops of a ring that crosses itself add
   * up with their signs.
   */
  readonly area: number;
}

/**
 * Metres from the first vertex. Up to here the area between chords is nearer to the truth than the area between
 * geodesics: the latter is a sum of areas down to the equator, whose rounding leaves 5e-5 m² however small the polygon
 * (0.04 m² around a pole); the former lacks the share extent² / (17 R²) of the area, 5e-5 m² at half a kilometre
 * (both measured on polygons of 24 vertices).
 */
const SMALL = 500;

/**
 * Perimeter and area of a polygon on the ellipsoid, also around a pole, across the antimeridian, or both.
 *
 * Karney, "Algorithms for geodesics", J. Geodesy 87 (2013) 43–55, section 6, as GeographicLib has it; polygons within
 * half a kilometre are measured along their chords ({@link chordPolygon}), which is twenty times faster and the more
 * exact. Errors of the area: below 1e-4 m² up to there, then below 0.1 m², whatever the size; of the perimeter: 1e-9 of
 * itself.
 *
 * @param ring longitude, latitude of each vertex in turn, radians; the first is not repeated at the end
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function geodesicPolygon(ring: ArrayLike<number>, ellipsoid: Ellipsoid = WGS84): GeodesicPolygon {
  requireKind(ring, "numbers", "geodesicPolygon: ring");
  const chords = chordPolygon(ring, ellipsoid);
  if (chords.extent <= SMALL) return { perimeter: chords.perimeter, area: chords.area };
  const polygon = solverOf(ellipsoid).Polygon();
  for (let i = 0; i < ring.length; i += 2) polygon.AddPoint(degrees(ring[i + 1]), degrees(ring[i]));
  const { perimeter, area = Number.NaN } = polygon.Compute(false, true);
  return { perimeter, area };
}

/** A polygon measured along chords through the ellipsoid. */
export interface ChordPolygon extends GeodesicPolygon {
  /** Greatest distance of a vertex from the first, metres. */
  readonly extent: number;
}

/**
 * Perimeter and area of a polygon between chords through the ellipsoid; the area is half the sum of the cross products of
 * its vertices in ECEF, as a length. Formed from differences to the first vertex, so that it is right to 1e-9 m times the
 * perimeter; a chord is shorter than its geodesic by length³ / (24 R²), 1 µm for a kilometre.
 *
 * @param ring longitude, latitude of each vertex in turn, radians
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function chordPolygon(ring: ArrayLike<number>, ellipsoid: Ellipsoid = WGS84): ChordPolygon {
  requireKind(ring, "numbers", "chordPolygon: ring");
  if (ring.length < 2) return { perimeter: 0, area: 0, extent: 0 };
  const first = new Float64Array(3);
  const point = new Float64Array(3);
  geodeticToEcef(ring[0], ring[1], 0, first, 0, ellipsoid);
  let [x0, y0, z0] = [0, 0, 0];
  let [sumX, sumY, sumZ] = [0, 0, 0];
  let perimeter = 0;
  let extent = 0;
  for (let i = 2; i < ring.length; i += 2) {
    geodeticToEcef(ring[i], ring[i + 1], 0, point, 0, ellipsoid);
    const x = point[0] - first[0];
    const y = point[1] - first[1];
    const z = point[2] - first[2];
    sumX += y0 * z - z0 * y;
    sumY += z0 * x - x0 * z;
    sumZ += x0 * y - y0 * x;
    perimeter += Math.hypot(x - x0, y - y0, z - z0);
    extent = Math.max(extent, Math.hypot(x, y, z));
    x0 = x;
    y0 = y;
    z0 = z;
  }
  perimeter += Math.hypot(x0, y0, z0);
  const up = sumX * first[0] + sumY * first[1] + sumZ * first[2];
  return { perimeter, area: (Math.sign(up) * Math.hypot(sumX, sumY, sumZ)) / 2, extent };
}
