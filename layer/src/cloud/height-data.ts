import {
  type Crs,
  decodeEgm96,
  ecefToGeodetic,
  type Grid,
  guessHeight,
  type HeightGuess,
  PlacementError,
  type VerticalSystem,
} from "@groma/georef";
import type { SourceBox } from "../sources/contract/point-source.js";
import { once, packagedFile } from "./packaged-file.js";

/** What it takes to place heights above a geoid where no conversion has settled them. Large, so fetched when needed. */
export interface HeightData {
  /** The vertical systems of EPSG. */
  systems(): Promise<readonly VerticalSystem[]>;
  /** The geoid model EGM96. */
  egm96(): Promise<Grid>;
}

const SYSTEMS = new URL("./vertical-systems.json", import.meta.url);
const GEOID = new URL("./egm96.bin", import.meta.url);
const HEIGHTS = { code: "SOURCE_HEIGHTS", what: "the data of height systems" } as const;

/** The files that lie beside this library: 51 kB of systems, 1.1 MB of geoid. */
export const packagedHeights: HeightData = {
  systems: once(() => packagedFile(SYSTEMS, HEIGHTS, (response) => response.json())),
  egm96: once(() =>
    packagedFile(GEOID, HEIGHTS, async (response) =>
      decodeEgm96(new Uint8Array(await response.arrayBuffer()), GEOID.href),
    ),
  ),
};

/**
 * What the heights of a data set may be that does not say: the height systems in use where it lies, and how far off
 * its points are if they stand above sea level and not above the ellipsoid. An offer to the reader; nothing follows it.
 *
 * @param cloud a `PointCloud`
 * @returns undefined where the middle of the data set has no place
 * @throws SourceError SOURCE_HEIGHTS
 */
export async function guessHeights(
  cloud: {
    readonly crs: Crs;
    readonly boundingBox: SourceBox;
    place(x: number, y: number, z: number): Float64Array;
  },
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
