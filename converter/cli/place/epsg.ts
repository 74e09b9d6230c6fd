import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import {
  type EpsgEntry,
  type EpsgLookup,
  type EpsgRow,
  type VerticalSystem,
  verticalSystems,
} from "@groma/georef";

const folder = join(dirname(createRequire(import.meta.url).resolve("epsg-index/package.json")), "s");

/** The EPSG table that comes with this package; works without a network, reads one small file per code. */
export const epsg: EpsgLookup = (code) => {
  if (!Number.isInteger(code)) return undefined;
  try {
    return entryOf(JSON.parse(readFileSync(join(folder, `${code}.json`), "utf8")));
  } catch {
    return undefined;
  }
};

/** All of the table: eight megabytes, so only where something is searched for. */
export function epsgRows(): EpsgRow[] {
  const table = JSON.parse(readFileSync(join(folder, "../all.json"), "utf8")) as Record<string, TableRow>;
  return Object.values(table).map((row) => ({ code: Number(row.code), ...entryOf(row) }));
}

let heights: readonly VerticalSystem[] | undefined;

/** The vertical systems of the table; read once. */
export function heightSystems(): readonly VerticalSystem[] {
  heights ??= verticalSystems(epsgRows());
  return heights;
}

/** A row as the table writes it. */
interface TableRow {
  readonly code: string;
  readonly name: string;
  readonly kind: string;
  readonly proj4: string | null;
  readonly wkt: string | null;
  readonly bbox: readonly number[] | null;
  readonly area: string | null;
}

function entryOf({ name, kind, proj4, wkt, bbox, area }: TableRow): EpsgEntry {
  return {
    ...{ name, kind, proj4: proj4 ?? undefined, wkt: wkt ?? undefined },
    ...{ bbox: bbox ?? undefined, area: area ?? undefined },
  };
}
