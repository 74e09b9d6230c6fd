import {
  type Crs,
  CrsError,
  type Domain,
  EGM96,
  ecefToGeodetic,
  geodeticToEcef,
  pointTransform,
  publishedAccuracy,
  type Truth,
  truthOf,
  withWorthThere,
} from "@groma/georef";
import { WGS84_ENSEMBLE } from "../proj/known-crs.js";
import type { EngineReport } from "../proj/report.js";
import { geoidsOf } from "./geoids.js";

/** Metres in plane up to which two ways lead to one place; both are fitted or computed to some hundredths of a millimetre. */
const SAME = 1e-3;
/**
 * The report of an engine with what is known of the datum shift of the CRS itself, where both lead to the same places in
 * plane: whatever PROJ calls its way, the operation's stated accuracy holds for it. PROJ does not know the accuracy of a
 * shift that stands in a PROJ string, and takes an ensemble of datums (WGS 84: 2 m) for one datum.
 *
 * @param truth the engine's way, source coordinates → ECEF
 */
export function withKnownShift(report: EngineReport, crs: Crs, truth: Truth, domain: Domain): EngineReport {
  const { datum } = crs;
  const published = datum && publishedAccuracy(datum);
  if (!datum || typeof published !== "number" || report.ballpark || report.unstated) return report;
  if (report.accuracy !== null && report.accuracy >= published) return report;
  // The accuracy of a way through a country's geoid is that of heights too, which the shift says nothing of.
  const ownGeoid = geoidsOf(truth).some((grid) => grid !== EGM96);
  if (report.accuracy === null && ownGeoid) return report;
  // A way of no worth at all is a conversion alone, and one from the ensemble of WGS 84 says nothing of that: what the datum
  // itself is worth is not in them.
  const isOfHeights = report.accuracy !== null && datum.datum === WGS84_ENSEMBLE;
  if (report.accuracy !== 0 && !isOfHeights && !isSamePlace(truth, crs, domain)) return report;
  if (report.accuracy !== null) return { ...report, accuracy: published };
  const accuracy = withWorthThere(crs, truth, domain).datum?.accuracy ?? null;
  return { ...report, operation: datum.operation, accuracy };
}

/** Whether the corners and the middle of a domain have the longitude and latitude that the CRS's own shift gives them. */
function isSamePlace(truth: Truth, crs: Crs, { minX, minY, minZ, maxX, maxY, maxZ }: Domain): boolean {
  const z = (minZ + maxZ) / 2;
  const own = ownTruth(crs, z);
  if (!own) return false;
  const ways = [pointTransform(truth), pointTransform(own)];
  const corners = [minX, maxX].flatMap((x) => [minY, maxY].map((y) => [x, y] as const));
  return [...corners, [(minX + maxX) / 2, (minY + maxY) / 2] as const].every(([x, y]) => {
    const [a, b] = ways.map((way) => {
      const ecef = new Float64Array(3);
      way(x, y, z, ecef, 0);
      const geodetic = new Float64Array(3);
      ecefToGeodetic(ecef[0]!, ecef[1]!, ecef[2]!, geodetic);
      // In space, on the ellipsoid: longitudes jump at 180°, and are none at a pole.
      geodeticToEcef(geodetic[0]!, geodetic[1]!, 0, ecef);
      return ecef;
    }) as [Float64Array, Float64Array];
    return Math.hypot(...a.map((value, axis) => value - b[axis]!)) < SAME;
  });
}

/** The way of the CRS's own shift, heights as they are; undefined where proj4js cannot go it. */
function ownTruth(crs: Crs, z: number): Truth | undefined {
  try {
    return truthOf({ crs: { ...crs, height: { kind: "unknown" } } }, z, crs.name);
  } catch (error) {
    if (error instanceof CrsError) return undefined;
    throw error;
  }
}
