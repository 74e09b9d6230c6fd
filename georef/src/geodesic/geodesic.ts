import { type Ellipsoid, WGS84 } from "../ellipsoid/ellipsoid.js";
import { AZIMUTH, DISTANCE, degrees, LATITUDE, LONGITUDE, radians, solverOf } from "./geographiclib.js";

/** The shortest line on the ellipsoid between two points. */
export interface Geodesic {
  /** Metres on the ellipsoid; heights have no part in it. */
  readonly distance: number;
  /** Direction of the line at the first point, radians clockwise from north, −π … π. */
  readonly azimuthFrom: number;
  /** Direction of the line, still away from the first point, at the second point. */
  readonly azimuthTo: number;
}

/** Where a geodesic ends. */
export interface GeodesicEnd {
  /** Radians, −π … π. */
  readonly longitude: number;
  /** Radians. */
  readonly latitude: number;
  /** Direction of the line there, radians clockwise from north. */
  readonly azimuth: number;
}

/**
 * The inverse problem: the geodesic between two points, right to 15 nm between any two, antipodes and poles included.
 * Of several shortest lines (from pole to pole, between antipodes) it is one; between coincident points azimuths are 0.
 *
 * Karney, "Algorithms for geodesics", J. Geodesy 87 (2013) 43–55, as GeographicLib has it.
 *
 * @param longitude1 radians, as the other angles; longitudes may differ by any number of turns
 * @returns NaN throughout where a latitude is beyond a pole
 */
export function geodesicBetween(
  longitude1: number,
  latitude1: number,
  longitude2: number,
  latitude2: number,
  ellipsoid: Ellipsoid = WGS84,
): Geodesic {
  const {
    s12 = Number.NaN,
    azi1 = Number.NaN,
    azi2 = Number.NaN,
  } = solverOf(ellipsoid).Inverse(
    degrees(latitude1),
    degrees(longitude1),
    degrees(latitude2),
    degrees(longitude2),
    DISTANCE | AZIMUTH,
  );
  return { distance: s12, azimuthFrom: radians(azi1), azimuthTo: radians(azi2) };
}

/**
 * The direct problem: the end of a geodesic of a given start, direction and length, right to 15 nm.
 *
 * @param longitude radians, as the other angles
 * @param azimuth clockwise from north
 * @param distance metres; negative ones lead the other way
 * @returns NaN throughout where the latitude is beyond a pole
 */
export function geodesicFrom(
  longitude: number,
  latitude: number,
  azimuth: number,
  distance: number,
  ellipsoid: Ellipsoid = WGS84,
): GeodesicEnd {
  const {
    lat2 = Number.NaN,
    lon2 = Number.NaN,
    azi2 = Number.NaN,
  } = solverOf(ellipsoid).Direct(
    degrees(latitude),
    degrees(longitude),
    degrees(azimuth),
    distance,
    LATITUDE | LONGITUDE | AZIMUTH,
  );
  return { longitude: radians(lon2), latitude: radians(lat2), azimuth: radians(azi2) };
}
