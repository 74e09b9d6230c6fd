import { open } from "node:fs/promises";
import { openGeoTiff } from "./geotiff.js";
import { type GridImage, type GridKind, unreadable } from "./grid-image.js";
import { openGtx } from "./gtx.js";
import { openNtv2 } from "./ntv2.js";

/**
 * Opens a grid file by what its first bytes say.
 *
 * @param name file name, for people
 * @throws ProjError PROJ_GRID when it cannot be read, or is in a format that is not known here
 */
export async function openGrid(path: string, name: string, kind: GridKind): Promise<GridImage[]> {
  const magic = await firstBytes(path, name);
  if (/^(II[*+]\0|MM\0[*+])/.test(magic)) return openGeoTiff(path, name, kind);
  if (kind === "horizontal" && magic.startsWith("NUM_OREC")) return openNtv2(path, name);
  if (kind === "vertical" && /\.gtx$/i.test(path)) return openGtx(path, name);
  throw unreadable(name, `it is no ${kind === "vertical" ? "GeoTIFF or GTX" : "GeoTIFF or NTv2"} grid`);
}

async function firstBytes(path: string, name: string): Promise<string> {
  try {
    const file = await open(path);
    try {
      const { buffer, bytesRead } = await file.read(Buffer.alloc(8), 0, 8, 0);
      return buffer.toString("latin1", 0, bytesRead);
    } finally {
      await file.close();
    }
  } catch (error) {
    throw unreadable(name, `it cannot be opened (${error instanceof Error ? error.message : String(error)})`);
  }
}
