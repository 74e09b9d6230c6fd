import { existsSync, statSync } from "node:fs";
import { dirname } from "node:path";
import { GromaError } from "@groma/georef";

/** The output cannot be written. Codes: OUTPUT_EXISTS, OUTPUT_INPUT, OUTPUT_NAME, OUTPUT_WRITE, as the core has them. */
export class OutputError extends GromaError {
  static override readonly kind = "OutputError";
}

/**
 * Refuses an output that is a file that the command reads, by whatever name: writing it would destroy what was given.
 *
 * @param read files or addresses; undefined for what was not given
 * @throws OutputError OUTPUT_INPUT
 */
export function requireOther(output: string, read: readonly (string | undefined)[]): void {
  const place = identityOf(output);
  if (place === undefined || !read.some((file) => file !== undefined && identityOf(file) === place)) return;
  throw new OutputError({
    ...{ code: "OUTPUT_INPUT", file: output, cause: "the output is one of the files that are read" },
    fix: "name another output file",
  });
}

/** Device and number of a file, the same for all links to it; undefined where there is none, as for an address. */
function identityOf(path: string): string | undefined {
  try {
    const { dev, ino } = statSync(path, { bigint: true });
    return `${dev} ${ino}`;
  } catch {
    return undefined;
  }
}

/**
 * Refuses an output that must not or cannot be written, before any work.
 *
 * @param read all files that the command reads, as {@link requireOther} takes them
 * @throws OutputError OUTPUT_EXISTS, OUTPUT_INPUT, OUTPUT_WRITE
 */
export function requirePlace(
  output: string,
  overwrite: boolean,
  read: readonly (string | undefined)[],
): void {
  requireOther(output, read);
  const refuse = (code: string, cause: string, fix: string) =>
    new OutputError({ code, file: output, cause, fix });
  if (statSync(output, { throwIfNoEntry: false })?.isDirectory()) {
    throw refuse("OUTPUT_WRITE", "this is a folder", "name an output file");
  }
  if (!existsSync(dirname(output))) {
    throw refuse("OUTPUT_WRITE", "its folder does not exist", "create the folder, or name another");
  }
  if (existsSync(output) && !overwrite) {
    throw refuse("OUTPUT_EXISTS", "the file already exists", "give --overwrite, or another name");
  }
}
