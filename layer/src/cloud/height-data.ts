import { decodeEgm96, type Grid, type VerticalSystem } from "@groma/georef";
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
