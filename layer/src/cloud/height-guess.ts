import { ecefToGeodetic, guessHeight, type HeightGuess, PlacementError } from "@groma/georef";
import { type HeightData, packagedHeights } from "./height-data.js";
import type { PointCloud } from "./point-cloud.js";

/**
 * What the heights of a data set may be that does not say: the height systems in use where it lies, and how far off
 * its points are if they stand above sea level and not above the ellipsoid. An offer to the reader; nothing follows it.
 *
 * @returns undefined where the middle of the data set has no place
 * @throws SourceError SOURCE_HEIGHTS
 */
export async function guessHeights(
  cloud: Pick<PointCloud, "crs" | "boundingBox" | "place">,
  data: HeightData = packagedHeights,
): Promise<HeightGuess | undefined> {
  const { min, max } = cloud.boundingBox;
  const [x, y, z] = min.map((least, axis) => (least + max[axis]) / 2);
  const geodetic = new Float64Array(3);
  try {
    const ecef = cloud.place(x, y, z);
    ecefToGeodetic(ecef[0], ecef[1], ecef[2], geodetic);
  } catch (thrown) {
    if (thrown instanceof PlacementError) return undefined;
    throw thrown;
  }
  const [egm96, systems] = await Promise.all([data.egm96(), data.systems()]);
  return guessHeight(egm96, systems, cloud.crs, geodetic[0], geodetic[1]);
}
