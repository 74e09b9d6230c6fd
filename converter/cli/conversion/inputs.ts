import { type Dirent, existsSync, readdir, realpathSync, statSync } from "node:fs";
import { basename, dirname, isAbsolute, join, resolve } from "node:path";
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
 * a file that is covered twice, be it through links, is taken once. Links to nothing and what is no regular file are among
 * them, so that whoever opens them tells that they are missing.
 *
 * @throws InputError INPUT_NOT_FOUND for a pattern or a folder without a scan; a file that is not there is left to
 * whoever opens it
 */
export async function expandInputs(args: readonly string[], output: string): Promise<string[]> {
  const found = new Map<string, string>();
  for (const argument of args) {
    for (const file of await expanded(argument, output)) {
      const key = isAddress(file) ? file : leadsTo(file);
      if (!found.has(key)) found.set(key, file);
    }
  }
  return [...found.values()];
}

/** The file that a path leads to, links followed as far as they lead. */
function leadsTo(path: string): string {
  try {
    return realpathSync(path);
  } catch {
    const whole = resolve(path);
    const above = dirname(whole);
    return above === whole ? whole : join(leadsTo(above), basename(whole));
  }
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
    fs: { readdir: withStrangeFiles as typeof readdir },
  });
  const target = leadsTo(output);
  // Of several paths to a file, the one with the fewest links is the shortest as a rule.
  const found = new Map<string, string>();
  for (const file of files.sort((a, b) => a.length - b.length || byCodeUnits(a, b))) {
    const own = leadsTo(file);
    if (own !== target && !found.has(own)) found.set(own, file);
  }
  const inputs = [...found.values()].sort(byCodeUnits);
  if (inputs.length > 0) return inputs;
  throw new InputError({
    code: "INPUT_NOT_FOUND",
    file: argument,
    cause: folder === undefined ? "no file matches the pattern" : "this folder contains no scan",
    fix: "name files, patterns that match files, or folders with LAS, LAZ, E57, BPF, PCD, PLY or PTS files",
  });
}

/**
 * What a folder holds, where all that leads to no folder counts as a file. The search passes over links to nothing, pipes
 * and devices: a tile on a disk that is not there would be missing from the result without a word.
 */
function withStrangeFiles(
  folder: string,
  _: { readonly withFileTypes: true },
  done: (error: Error | null, entries: Dirent[]) => void,
): void {
  readdir(folder, { withFileTypes: true }, (error, entries) => {
    for (const entry of entries ?? []) {
      if (entry.isDirectory() || entry.isFile() || leadsToFolder(join(folder, entry.name))) continue;
      entry.isFile = () => true;
    }
    done(error, entries);
  });
}

function leadsToFolder(path: string): boolean {
  try {
    return statSync(path).isDirectory();
  } catch {
    return false;
  }
}

function portablePath(folder: string): string {
  return (process.platform === "win32" ? folder.replaceAll("\\", "/") : folder).replace(/\/+$/, "") || "/";
}

/** The same order everywhere, whatever the language of the user. */
function byCodeUnits(a: string, b: string): number {
  return a < b ? -1 : a > b ? 1 : 0;
}
