import { existsSync, statSync } from "node:fs";
import { isAbsolute, resolve } from "node:path";
import { GromaError } from "@groma/georef";

/** Inputs cannot be found. Codes: INPUT_NOT_FOUND, INPUT_NONE. */
export class InputError extends GromaError {
  static override readonly kind = "InputError";
}

/** What a folder is searched for; scans in other formats have to be named. */
const IN_FOLDERS = "**/*.{las,laz,e57,bpf,pcd,ply,pts}";

/** Characters that make a pattern of a path that names no file. */
const MAGIC = /[*?[\]{}()!]/;

/** An address of something that PDAL reads over the network. */
export const isAddress = (input: string): boolean => /^[a-z][a-z0-9+.-]+:\/\//i.test(input);

/**
 * The files that the arguments of a command mean: files, patterns (for shells that do not expand them), and folders with
 * all scans in them and in the folders below. Hidden files and folders are passed over, and so is the output, where a
 * pattern or a folder covers it. What an argument covers is sorted by path, so that every machine finds the same order;
 * a file that is covered twice is taken once.
 *
 * @throws InputError INPUT_NOT_FOUND for a pattern or a folder without a scan; a file that is not there is left to
 * whoever opens it
 */
export async function expandInputs(args: readonly string[], output: string): Promise<string[]> {
  const found = new Map<string, string>();
  for (const argument of args) {
    for (const file of await expanded(argument, output)) {
      const key = isAddress(file) ? file : resolve(file);
      if (!found.has(key)) found.set(key, file);
    }
  }
  return [...found.values()];
}

async function expanded(argument: string, output: string): Promise<string[]> {
  if (isAddress(argument)) return [argument];
  if (statSync(argument, { throwIfNoEntry: false })?.isDirectory()) {
    return matches(IN_FOLDERS, argument, argument, output);
  }
  if (existsSync(argument) || !MAGIC.test(argument)) return [argument];
  return matches(argument, undefined, argument, output);
}

async function matches(
  pattern: string,
  folder: string | undefined,
  argument: string,
  output: string,
): Promise<string[]> {
  const { glob, escapePath } = await import("tinyglobby");
  // A pattern of Windows has backslashes, which the language of patterns keeps for escapes.
  const portable = process.platform === "win32" ? pattern.replaceAll("\\", "/") : pattern;
  const whole = folder === undefined ? portable : `${escapePath(portablePath(folder))}/${portable}`;
  const files = await glob(whole, {
    caseSensitiveMatch: false,
    expandDirectories: false,
    absolute: isAbsolute(whole),
  });
  const target = resolve(output);
  const inputs = files.filter((file) => resolve(file) !== target).sort(byCodeUnits);
  if (inputs.length > 0) return inputs;
  throw new InputError({
    code: "INPUT_NOT_FOUND",
    file: argument,
    cause: folder === undefined ? "no file matches the pattern" : "this folder contains no scan",
    fix: "name files, patterns that match files, or folders with LAS, LAZ, E57, BPF, PCD, PLY or PTS files",
  });
}

function portablePath(folder: string): string {
  return (process.platform === "win32" ? folder.replaceAll("\\", "/") : folder).replace(/\/+$/, "") || "/";
}

/** The same order everywhere, whatever the language of the user. */
function byCodeUnits(a: string, b: string): number {
  return a < b ? -1 : a > b ? 1 : 0;
}
