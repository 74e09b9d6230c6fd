import { eastNorthUp, pointOf } from "@groma/georef";
import fc from "fast-check";
import { cloudOf, UTM } from "../cloud.fixture.js";
import { ecefVertex, placeVertex, type Vertex } from "../index.js";

export const finite = (min: number, max: number) =>
  fc.double({ min, max, noNaN: true, noDefaultInfinity: true });
export const DEGREE = Math.PI / 180;
/** Anywhere on the earth, from 100 m below the ellipsoid to 9 km above it. */
export const place = fc
  .tuple(finite(-Math.PI, Math.PI), finite(-Math.PI / 2, Math.PI / 2), finite(-100, 9000))
  .map(([longitude, latitude, height]) => placeVertex(longitude, latitude, height));

/** A vertex by metres east, north and up of a place. */
export function beside(
  longitude: number,
  latitude: number,
  height: number,
  e: number,
  n: number,
  u: number,
): Vertex {
  return ecefVertex(pointOf(eastNorthUp(placeVertex(longitude, latitude, height).ecef), e, n, u));
}

export const utm = cloudOf(UTM);
