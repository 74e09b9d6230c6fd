import type { OperationReport } from "@groma/georef";

/** A better way that lacks grids. */
export interface Remedy {
  readonly operation: string;
  /** Metres as published; null where nobody has stated it. */
  readonly accuracy: number | null;
  readonly grids: readonly MissingGrid[];
}

/** A grid that is not there. */
interface MissingGrid {
  /** As PROJ names it. */
  readonly name: string;
  /** What fetches it; absent for grids that PROJ-data has not. */
  readonly get?: string;
  readonly url?: string;
}

/** Where PROJ-data is published; its names are unique, whatever the institution. */
const PROJ_DATA = "https://cdn.proj.org/";

/** The better ways of a report, each set of grids once, and how their grids are had. */
export function remedies(operation: Pick<OperationReport, "lacking"> | undefined): Remedy[] {
  const found = new Map<string, Remedy>();
  for (const { name, accuracy, grids } of operation?.lacking ?? []) {
    const key = [...grids].sort().join(" ");
    const known = found.get(key);
    if (known && (known.accuracy ?? Number.POSITIVE_INFINITY) <= (accuracy ?? Number.POSITIVE_INFINITY))
      continue;
    found.set(key, { operation: name, accuracy, grids: grids.map(missingGrid) });
  }
  return [...found.values()];
}

function missingGrid(name: string): MissingGrid {
  // What PROJ-data has is a GeoTIFF there; other names are those of publishers.
  if (!/^[\w.+-]+\.tif$/i.test(name)) return { name };
  return { name, get: `projsync --file ${name}`, url: `${PROJ_DATA}${name}` };
}
