import {
  CrsError,
  type CrsSources,
  type EpsgLookup,
  epsgLookup,
  type PackedEpsg,
  type ResolvedCrs,
  resolveWithNotes,
  verticalLookup,
} from "@groma/georef";
import { SourceError } from "../errors/index.js";
import type { HeightData } from "./height-data.js";
import { once, packagedFile } from "./packaged-file.js";

const TABLE = new URL("./epsg.json", import.meta.url);
const EPSG = { code: "SOURCE_EPSG", what: "the table of EPSG codes" } as const;

/** The table of EPSG codes that lies beside this library: 0.7 MB, a sixth of that compressed; fetched when needed. */
export const packagedEpsg: () => Promise<PackedEpsg> = once(() =>
  packagedFile(TABLE, EPSG, (response) => response.json()),
);

/** Where codes are looked up. */
export interface Tables {
  /** The application's own table, which is asked first. */
  readonly epsg: EpsgLookup | undefined;
  readonly epsgTable: () => Promise<PackedEpsg>;
  readonly heightData: HeightData;
}

/**
 * The coordinate system of a data set. The table beside this library is fetched where a code is met that the
 * application's own does not have. A data set that can be placed without it is placed all the same where it cannot be
 * had, and the notes say so.
 *
 * @throws CrsError as `resolveCrs`; SourceError SOURCE_EPSG, SOURCE_HEIGHTS
 */
export async function declaredCrs(
  sources: CrsSources,
  { epsg, epsgTable, heightData }: Tables,
): Promise<ResolvedCrs> {
  let missed = false;
  const own: EpsgLookup = (code) => {
    const entry = epsg?.(code);
    missed ||= entry === undefined;
    return entry;
  };
  let first: ResolvedCrs | undefined;
  try {
    first = resolveWithNotes(sources, own);
  } catch (thrown) {
    if (!missed || !(thrown instanceof CrsError)) throw thrown;
  }
  if (first && !missed) return first;
  try {
    const [packed, systems] = await Promise.all([epsgTable(), heightData.systems()]);
    const table = epsgLookup(packed, verticalLookup(systems));
    return resolveWithNotes(sources, (code) => epsg?.(code) ?? table(code));
  } catch (thrown) {
    if (!first || !(thrown instanceof SourceError)) throw thrown;
    const text = `its EPSG codes could not be looked up: ${thrown.cause}`;
    return { ...first, notes: [...first.notes, { code: thrown.code, text }] };
  }
}
