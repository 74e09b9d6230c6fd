import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { type EpsgRow, type VerticalSystem, verticalSystems } from "@groma/georef";

/** The vertical systems of the EPSG table that comes with this package; reads all of it, so only where one is looked for. */
export function heightSystems(): VerticalSystem[] {
  const path = createRequire(import.meta.url).resolve("epsg-index/all.json");
  const table = JSON.parse(readFileSync(path, "utf8")) as Record<string, EpsgRow>;
  return verticalSystems(Object.values(table));
}
