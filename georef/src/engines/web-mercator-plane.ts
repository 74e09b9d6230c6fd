import { WEB_MERCATOR } from "../crs/web-mercator.js";
import { WGS84 } from "../ellipsoid/ellipsoid.js";
import { type MapPlane, type PlaneTransform, truthToPlane } from "./on-map.js";
import type { Truth } from "./truth.js";

/** The plane of most maps, in the words of {@link MapPlane}: Web Mercator (EPSG:3857), world after world. */
export const WEB_MERCATOR_PLANE = {
  code: "EPSG:3857",
  definition: `${WEB_MERCATOR} +a=6378137 +b=6378137 +units=m +nadgrids=@null +no_defs`,
  metresPerUnit: 1,
  wraps: true,
} as const;

const TURN = 2 * Math.PI;

/**
 * The map of a data set to the plane of Web Mercator, as `truthOnMap` has it, without proj4js.
 *
 * @param middle middle height of the data set, source units
 * @param verticalUnit metres per source unit of z
 * @returns undefined for any plane that is not given as {@link WEB_MERCATOR_PLANE}
 */
export function truthOnWebMercator(
  truth: Truth,
  plane: MapPlane,
  middle: number,
  verticalUnit: number,
  file: string,
): Truth | undefined {
  const { definition, wraps, metresPerUnit } = plane;
  if (definition !== WEB_MERCATOR_PLANE.definition || !wraps || metresPerUnit !== 1) return undefined;
  return truthToPlane(truth, plane, webMercator(plane.middle), middle, verticalUnit, file);
}

/**
 * Spherical formulas on geodetic coordinates of WGS 84 (EPSG method 1024).
 * @param middle longitude whose turn is taken, radians
 */
function webMercator(middle: number): PlaneTransform {
  return (longitude, latitude, out, offset) => {
    out[offset] = Number.NaN;
    out[offset + 1] = Number.NaN;
    if (!Number.isFinite(longitude) || !(Math.abs(latitude) < Math.PI / 2)) return;
    out[offset] = WGS84.a * (longitude - TURN * Math.round((longitude - middle) / TURN));
    out[offset + 1] = WGS84.a * Math.log(Math.tan(Math.PI / 4 + latitude / 2));
  };
}
