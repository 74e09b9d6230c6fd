import { stat } from "node:fs/promises";
import { join } from "node:path";

/**
 * Grids that the databases of older PROJ name as their publishers do, and the files of PROJ-data that hold them (table
 * grid_alternatives of PROJ 9.5, as far as that of 9.1 lacks it; of grids that are one file).
 */
const CURRENT: ReadonlyMap<string, string> = new Map([
  ["GCG2016.txt", "de_bkg_gcg2016.tif"],
  ["GEOIDE-Ar16.gri", "ar_ign_GEOIDE-Ar16.tif"],
  ["HT2_1997_CGG2013a.byn", "ca_nrc_HT2_1997_CGG2013a.tif"],
  ["HT2_2002v70.byn", "ca_nrc_HT2_2002v70.tif"],
  ["HT2_2002v70_CGG2013a.byn", "ca_nrc_HT2_2002v70_CGG2013a.tif"],
  ["HeTa2010.gsb", "de_hvbg_hessen_HeTA2010.tif"],
]);

/** What of an operation names grids. */
interface Gridded {
  readonly missingGrids: readonly string[];
  /** Absent where PROJ cannot write the operation as one. */
  readonly pipeline?: string;
}

/**
 * An operation with the grids named as PROJ-data names them: one that PROJ has not found under the publisher's name is
 * used where it lies in PROJ's folders under that of PROJ-data, and named so where it does not.
 *
 * @param directories folders that PROJ looks for grids in
 */
export async function withCurrentNames<T extends Gridded>(
  operation: T,
  directories: readonly string[],
): Promise<T> {
  let { pipeline } = operation;
  const missingGrids: string[] = [];
  for (const grid of operation.missingGrids) {
    const current = CURRENT.get(grid) ?? grid;
    if (current === grid || !(await isThere(current, directories))) missingGrids.push(current);
    else pipeline = pipeline?.split(grid).join(current);
  }
  return { ...operation, missingGrids, ...(pipeline !== undefined && { pipeline }) };
}

async function isThere(name: string, directories: readonly string[]): Promise<boolean> {
  for (const directory of directories) {
    if (
      await stat(join(directory, name)).then(
        (found) => found.isFile(),
        () => false,
      )
    )
      return true;
  }
  return false;
}

/** How missing grids are had: what PROJ-data has is fetched by PROJ's own program. */
export function howToGet(grids: readonly string[]): string {
  const commands = grids.filter((grid) => /\.tif$/i.test(grid)).map((grid) => `\`projsync --file ${grid}\``);
  const [them, their] = grids.length === 1 ? ["it", "its"] : ["them", "their"];
  const folder = `give ${their} folder with --grids`;
  return commands.length === 0 ? folder : `get ${them} with ${commands.join(", ")}, or ${folder}`;
}
