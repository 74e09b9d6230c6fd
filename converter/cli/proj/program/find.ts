import { existsSync } from "node:fs";
import { homedir } from "node:os";
import { delimiter, join, resolve } from "node:path";
import { installedProj } from "../../installed/parts.js";
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

/** Where PROJ is looked for. */
export interface FindOptions {
  /** Folder of the programs; otherwise GROMA_PROJ names it, or they are looked for. */
  readonly folder?: string | undefined;
  /** A folder of grids that goes before PROJ's own. */
  readonly grids?: string | undefined;
  /** Defaults to the environment of this process. */
  readonly environment?: NodeJS.ProcessEnv | undefined;
  /** The PROJ that came with the core: a folder with `bin` and `share/proj`. Default: that of this installation. */
  readonly packaged?: string | undefined;
}

/** The oldest PROJ whose `projinfo` and `cct` answer as they are read here. */
const OLDEST = [9, 1] as const;
/** The oldest whose tables name the grids as PROJ-data does today. */
const CURRENT = [9, 6] as const;
/** Data of the PROJ that Debian installs for all its users, which `install-proj`'s lies beside. */
const OF_DEBIAN = "/usr/share/proj";

/** A PROJ that is Groma's own: `programs` and its database. */
interface OwnProj {
  readonly programs: string;
  readonly data: string;
}

/** The first that is there of: the one that `install-proj` put where it does unless told another place, the packaged one. */
function ownProj(environment: NodeJS.ProcessEnv, packaged: string | undefined): OwnProj | undefined {
  const brought = join(environment.XDG_CACHE_HOME || join(homedir(), ".cache"), "groma/proj");
  const places = [{ programs: join(brought, "bin"), data: join(brought, "usr/share/proj") }];
  if (packaged) places.push({ programs: join(packaged, "bin"), data: join(packaged, "share/proj") });
  const program = process.platform === "win32" ? "cct.exe" : "cct";
  return places.find(({ programs }) => existsSync(join(programs, program)));
}

/**
 * Looks for PROJ: where the user says, where GROMA_PROJ says, on PATH if that is a current one, where `install-proj`
 * puts it, in the package of the core, on PATH. Its network access stays off unless the user's environment turns it on (`PROJ_NETWORK=ON`).
 *
 * @returns nothing when no folder was given and there is no PROJ
 * @throws ProjError PROJ_MISSING when the given folder has none, PROJ_VERSION, PROJ_GRID when `grids` is no folder
 */
export async function findProj(options: FindOptions = {}): Promise<Proj | undefined> {
  const given = options.environment ?? process.env;
  const folder = options.folder ?? (given.GROMA_PROJ || undefined);
  // Numbers are written and read with a decimal point, whatever the user's language.
  const environment: NodeJS.ProcessEnv = { PROJ_NETWORK: "OFF", ...given, LC_ALL: "C" };
  delete environment.PROJ_DEBUG;
  const there = folder === undefined ? ownProj(given, options.packaged ?? installedProj) : undefined;
  const own = there && !(await hasCurrent(environment)) ? there : undefined;
  if (own) {
    // Its database before any other, since that of another version would not be read.
    const others = [given.PROJ_DATA ?? given.PROJ_LIB, existsSync(OF_DEBIAN) ? OF_DEBIAN : undefined];
    environment.PROJ_DATA = [own.data, ...others.filter(Boolean)].join(delimiter);
  }
  const programs = own?.programs ?? folder;
  const program = (name: string) => (programs === undefined ? name : join(programs, name));
  const projinfo = program("projinfo");
  const cct = program("cct");

  let version: string;
  try {
    const searching = searchPaths(projinfo, environment);
    // Where both fail, the version says more.
    searching.catch(() => undefined);
    version = await versionOf(cct, environment);
    const directories = await searching;
    if (options.grids === undefined) return { version, projinfo, cct, environment, directories };
    environment.PROJ_DATA = withFolder(options.grids, directories);
  } catch (error) {
    const absent = error instanceof ProjError && error.code === "PROJ_MISSING";
    if (absent && programs === undefined) return undefined;
    throw error;
  }
  return { version, projinfo, cct, environment, directories: await searchPaths(projinfo, environment) };
}

/** Whether PATH has a current PROJ. */
async function hasCurrent(environment: NodeJS.ProcessEnv): Promise<boolean> {
  try {
    return isAtLeast(CURRENT, await versionOf("cct", environment));
  } catch (error) {
    if (error instanceof ProjError) return false;
    throw error;
  }
}

function isAtLeast([major, minor]: readonly [number, number], version: string): boolean {
  const [ofMajor, ofMinor] = version.split(".").map(Number);
  return ofMajor > major || (ofMajor === major && ofMinor >= minor);
}

async function versionOf(cct: string, environment: NodeJS.ProcessEnv): Promise<string> {
  const { stdout, stderr } = await run(cct, ["--version"], { environment });
  const found = /Rel\. (\d+)\.(\d+)(?:\.(\d+))?/.exec(stdout + stderr);
  if (!found) throw failed(cct, "it does not tell its version");
  const version = `${found[1]}.${found[2]}.${found[3] ?? 0}`;
  if (!isAtLeast(OLDEST, version)) {
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
