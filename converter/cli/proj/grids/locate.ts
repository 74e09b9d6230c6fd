import { stat } from "node:fs/promises";
import { basename, dirname, join, resolve } from "node:path";
import type { Proj } from "../program/find.js";
import { run } from "../program/run.js";
import { unreadable } from "./grid-image.js";

/** Names that stay in the folder they are looked for in. */
const PLAIN = /^[A-Za-z0-9_][A-Za-z0-9_.+-]*(\/[A-Za-z0-9_][A-Za-z0-9_.+-]*)*$/;

/**
 * Path of a grid in PROJ's data folders. Where the file has an older name there than the one that PROJ's database
 * writes (`egm96_15.gtx` for `us_nga_egm96_15.tif`), PROJ itself is asked which one it opens.
 *
 * @returns nothing when there is no such grid
 * @throws ProjError PROJ_GRID when the name would lead out of the folders
 */
export async function locateGrid(proj: Proj, name: string): Promise<string | undefined> {
  if (!PLAIN.test(name)) throw unreadable(name.slice(0, 120), "it lies outside of PROJ's data folders");
  for (const directory of proj.directories) {
    const path = join(directory, name);
    if (await isFile(path)) return path;
  }
  return openedInstead(proj, name);
}

async function openedInstead(proj: Proj, name: string): Promise<string | undefined> {
  // Both kinds of shift: which one it is for decides only whether PROJ can read it.
  for (const kind of ["vgridshift", "hgridshift"]) {
    const { stderr } = await run(proj.cct, ["-t", "0", `+proj=${kind}`, `+grids=${name}`], {
      environment: { ...proj.environment, PROJ_DEBUG: "3" },
      input: "0 0 0\n",
    });
    const opened = [...stderr.matchAll(/pj_open_lib\([^)]*\): call fopen\((.+)\) - succeeded/g)]
      .map(([, path]) => path)
      .filter((path) => !/^proj\.(db|ini)$/.test(basename(path)));
    const folders = proj.directories.map((directory) => resolve(directory));
    const path = opened.find((candidate) => folders.includes(dirname(resolve(candidate))));
    if (path && (await isFile(path))) return path;
  }
  return undefined;
}

async function isFile(path: string): Promise<boolean> {
  try {
    return (await stat(path)).isFile();
  } catch {
    return false;
  }
}
