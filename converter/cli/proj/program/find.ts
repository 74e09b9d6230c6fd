import { existsSync } from "node:fs";
import { delimiter, join, resolve } from "node:path";
import { ProjError } from "./errors.js";
import { failed, run } from "./run.js";

/** PROJ's programs as they are found, and the surroundings that they are run in. */
export interface Proj {
  /** `9.1.1` */
  readonly version: string;
  readonly projinfo: string;
  readonly cct: string;
  readonly environment: NodeJS.ProcessEnv;
  /** Folders that PROJ looks for grids in, the first one first. */
  readonly directories: readonly string[];
}

export interface FindOptions {
  /** Folder of the programs; otherwise they are looked for on PATH. */
  readonly folder?: string | undefined;
  /** A folder of grids that goes before PROJ's own. */
  readonly grids?: string | undefined;
  /** Defaults to the environment of this process. */
  readonly environment?: NodeJS.ProcessEnv | undefined;
}

/** The oldest PROJ whose `projinfo` and `cct` answer as they are read here. */
const OLDEST = [9, 1];

/**
 * Looks for PROJ. Its network access stays off unless the user's environment turns it on (`PROJ_NETWORK=ON`).
 *
 * @returns nothing when no folder was given and PATH has no PROJ
 * @throws ProjError PROJ_MISSING when the given folder has none, PROJ_VERSION, PROJ_GRID when `grids` is no folder
 */
export async function findProj(options: FindOptions = {}): Promise<Proj | undefined> {
  const given = options.environment ?? process.env;
  // Numbers are written and read with a decimal point, whatever the user's language.
  const environment: NodeJS.ProcessEnv = { PROJ_NETWORK: "OFF", ...given, LC_ALL: "C" };
  delete environment.PROJ_DEBUG;
  const program = (name: string) => (options.folder === undefined ? name : join(options.folder, name));
  const projinfo = program("projinfo");
  const cct = program("cct");

  let version: string;
  try {
    version = await versionOf(cct, environment);
    const directories = await searchPaths(projinfo, environment);
    if (options.grids === undefined) return { version, projinfo, cct, environment, directories };
    environment.PROJ_DATA = withFolder(options.grids, directories);
  } catch (error) {
    const absent = error instanceof ProjError && error.code === "PROJ_MISSING";
    if (absent && options.folder === undefined) return undefined;
    throw error;
  }
  return { version, projinfo, cct, environment, directories: await searchPaths(projinfo, environment) };
}

async function versionOf(cct: string, environment: NodeJS.ProcessEnv): Promise<string> {
  const { stdout, stderr } = await run(cct, ["--version"], { environment });
  const found = /Rel\. (\d+)\.(\d+)(?:\.(\d+))?/.exec(stdout + stderr);
  if (!found) throw failed(cct, "it does not tell its version");
  const [major, minor] = [Number(found[1]), Number(found[2])];
  const version = `${major}.${minor}.${found[3] ?? 0}`;
  if (major < OLDEST[0] || (major === OLDEST[0] && minor < OLDEST[1])) {
    throw new ProjError({
      code: "PROJ_VERSION",
      file: cct,
      cause: `this is PROJ ${version}`,
      fix: `use PROJ ${OLDEST.join(".")} or newer, or convert with --engine proj4js`,
    });
  }
  return version;
}

async function searchPaths(projinfo: string, environment: NodeJS.ProcessEnv): Promise<string[]> {
  const { status, stdout } = await run(projinfo, ["--searchpaths"], { environment });
  if (status !== 0) throw failed(projinfo, "it does not tell where its data are");
  const lines = stdout.split(/\r?\n/).map((line) => line.trim());
  return [...new Set(lines.filter((line) => line !== ""))];
}

/** PROJ_DATA with the folder first; PROJ's own folders stay, because its database lies there. */
function withFolder(grids: string, directories: readonly string[]): string {
  const folder = resolve(grids);
  if (!existsSync(folder) || folder.includes(delimiter)) {
    throw new ProjError({
      code: "PROJ_GRID",
      file: grids,
      cause: existsSync(folder)
        ? `PROJ cannot be told of a path with "${delimiter}" in it`
        : "no such folder",
      fix: "give --grids the folder that holds the grid files",
    });
  }
  return [folder, ...directories].join(delimiter);
}
