import { createRequire } from "node:module";
import type { EpsgLookup } from "./crs.js";

/** The table of EPSG codes that the command line brings along. */
const epsgTable = createRequire(import.meta.url)("epsg-index/all.json") as Record<
  string,
  ReturnType<EpsgLookup>
>;

export const lookup: EpsgLookup = (code) => epsgTable[code];
