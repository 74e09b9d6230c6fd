import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import type { EpsgEntry, EpsgLookup } from "@groma/georef";

const folder = join(dirname(createRequire(import.meta.url).resolve("epsg-index/package.json")), "s");

/** The EPSG table that comes with this package; works without a network, reads one small file per code. */
export const epsg: EpsgLookup = (code) => {
  if (!Number.isInteger(code)) return undefined;
  let row: { name: string; kind: string; proj4: string | null; wkt: string | null };
  try {
    row = JSON.parse(readFileSync(join(folder, `${code}.json`), "utf8"));
  } catch {
    return undefined;
  }
  const entry: EpsgEntry = {
    name: row.name,
    kind: row.kind,
    proj4: row.proj4 ?? undefined,
    wkt: row.wkt ?? undefined,
  };
  return entry;
};
