import { type Crs, ecefToGeodetic, exactTransform, toEcef } from "@groma/georef";
import type { Scan } from "./core.js";

const DEGREE = Math.PI / 180;

/** Bounds of a data set on the earth: degrees, metres above the ellipsoid as far as its heights are that. */
export interface GeodeticBounds {
  readonly west: number;
  readonly south: number;
  readonly east: number;
  readonly north: number;
  readonly lowest: number;
  readonly highest: number;
}

/**
 * Longitudes and latitudes that the header's box covers, from its corners and the middles of its edges.
 *
 * @throws PlacementError PLACE_DOMAIN when the CRS has no such place
 */
export function geodeticBounds(scan: Scan, crs: Crs): GeodeticBounds {
  const exact = exactTransform(crs, (scan.min[2] + scan.max[2]) / 2);
  const ecef = new Float64Array(3);
  const geodetic = new Float64Array(3);
  const bounds = { west: 180, south: 90, east: -180, north: -90, lowest: Infinity, highest: -Infinity };
  const steps = [0, 0.5, 1];
  for (const u of steps) {
    for (const v of steps) {
      for (const w of [0, 1]) {
        const at = (axis: 0 | 1 | 2, share: number) =>
          scan.min[axis] + share * (scan.max[axis] - scan.min[axis]);
        toEcef(crs, exact, at(0, u), at(1, v), at(2, w), ecef);
        ecefToGeodetic(ecef[0]!, ecef[1]!, ecef[2]!, geodetic);
        const [longitude, latitude, height] = [geodetic[0]! / DEGREE, geodetic[1]! / DEGREE, geodetic[2]!];
        bounds.west = Math.min(bounds.west, longitude);
        bounds.east = Math.max(bounds.east, longitude);
        bounds.south = Math.min(bounds.south, latitude);
        bounds.north = Math.max(bounds.north, latitude);
        bounds.lowest = Math.min(bounds.lowest, height);
        bounds.highest = Math.max(bounds.highest, height);
      }
    }
  }
  return bounds;
}

/** What the heights of a data set are measured from, in words. */
export function heightInWords({ height }: Crs): string {
  switch (height.kind) {
    case "ellipsoidal":
      return "ellipsoidal";
    case "geoid":
      return `above ${height.model}${height.epsg ? ` (EPSG:${height.epsg})` : ""}, geoid not applied: shown as ellipsoidal`;
    case "unknown":
      return "unknown (shown as ellipsoidal)";
  }
}

/** Name of a CRS with its code, if the name does not have it. */
export function crsInWords({ name, code }: Crs): string {
  return code && !name.includes(code) ? `${code} ${name}` : name;
}

/** Points per square metre over the header's rectangle; undefined for a rectangle without area. */
export function density(scan: Scan, crs: Crs): number | undefined {
  const middle = ((scan.min[1] + scan.max[1]) / 2) * crs.horizontalUnit.size;
  const [east, north] =
    crs.horizontalUnit.kind === "angular"
      ? [crs.horizontalUnit.size * 6_378_137 * Math.cos(middle), crs.horizontalUnit.size * 6_378_137]
      : [crs.horizontalUnit.size, crs.horizontalUnit.size];
  const area = (scan.max[0] - scan.min[0]) * east * ((scan.max[1] - scan.min[1]) * north);
  return area > 0 ? scan.points / area : undefined;
}
