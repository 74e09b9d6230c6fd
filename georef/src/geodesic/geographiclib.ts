import geographiclib from "geographiclib-geodesic";
import { type Ellipsoid, WGS84 } from "../ellipsoid/ellipsoid.js";

/** One ellipsoid of GeographicLib; it takes and gives degrees. */
export type Solver = InstanceType<typeof geographiclib.Geodesic.Geodesic>;

/** What GeographicLib is asked to compute. */
export const { DISTANCE, AZIMUTH, LATITUDE, LONGITUDE } = geographiclib.Geodesic;

const solvers = new WeakMap<Ellipsoid, Solver>([[WGS84, geographiclib.Geodesic.WGS84]]);

/** The solver of an ellipsoid; its series are computed once. */
export function solverOf(ellipsoid: Ellipsoid): Solver {
  const known = solvers.get(ellipsoid);
  if (known) return known;
  const made = new geographiclib.Geodesic.Geodesic(ellipsoid.a, ellipsoid.f);
  solvers.set(ellipsoid, made);
  return made;
}

/** Radians per degree. */
const DEGREE = Math.PI / 180;

/** A quarter and a half turn come out exact, so that poles and antipodes stay what they are. */
export function degrees(radians: number): number {
  return radians / DEGREE;
}

/** Radians of degrees. */
export function radians(degrees: number): number {
  return degrees * DEGREE;
}
