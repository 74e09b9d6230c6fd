import { existsSync, statSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";
import { PdalError } from "./errors.js";
import { missing, runPdal } from "./run.js";

/** PDAL as it is found. */
export interface Pdal {
  readonly program: string;
  /** `2.2.0` */
  readonly version: string;
}

/** Where `install-pdal` puts it unless it is told another place. */
const installed = (environment: NodeJS.ProcessEnv): string =>
  join(environment.XDG_CACHE_HOME || join(homedir(), ".cache"), "groma/pdal/bin/pdal");

/**
 * Looks for PDAL: where the user says, where GROMA_PDAL says, on PATH, where `install-pdal` puts it.
 *
 * @param given program, or the folder that it is in; it is not replaced by another one
 * @param input the file that PDAL is needed for
 * @throws PdalError PDAL_MISSING
 */
export async function findPdal(
  given: string | undefined,
  input: string,
  environment: NodeJS.ProcessEnv = process.env,
): Promise<Pdal> {
  const named = given ?? (environment.GROMA_PDAL || undefined);
  if (named !== undefined) return started(programIn(named));
  for (const program of ["pdal", installed(environment)]) {
    try {
      return await started(program);
    } catch (error) {
      if (!(error instanceof PdalError)) throw error;
    }
  }
  throw missing(input, "PDAL, which reads formats other than LAS and LAZ and runs pipelines, was not found");
}

function programIn(path: string): string {
  const isFolder = existsSync(path) && statSync(path).isDirectory();
  return isFolder ? join(path, process.platform === "win32" ? "pdal.exe" : "pdal") : path;
}

async function started(program: string): Promise<Pdal> {
  const outcome = await runPdal(program, ["--version"], "");
  const version = /\bpdal (\d+\.\d+\.\d+)/i.exec(outcome.stdout + outcome.stderr)?.[1];
  if (outcome.status !== 0 || version === undefined) throw missing(program, "this program is not PDAL");
  return { program, version };
}
