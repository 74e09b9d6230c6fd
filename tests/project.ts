import { existsSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

/** Absolute path of the project's folder. */
export const projectRoot = join(dirname(fileURLToPath(import.meta.url)), "..");

/** Folder of the real scans and truth tables, beside the project; not part of it. */
export const dataFolder = join(projectRoot, "../shared/data");

/** Absolute path of a file of the data folder, and why a test that needs it is skipped, if it is not there. */
export function data(name: string): { path: string; missing: string | undefined } {
  const path = join(dataFolder, name);
  return { path, missing: existsSync(path) ? undefined : `${name} is not in ../shared/data` };
}
