import { existsSync, statSync } from "node:fs";
import { dirname } from "node:path";
import { GromaError } from "@groma/georef";

/** The output cannot be written. Codes: OUTPUT_EXISTS, OUTPUT_NAME, OUTPUT_WRITE, as the core has them. */
export class OutputError extends GromaError {
  static override readonly kind = "OutputError";
}

/** Refuses an output that must not or cannot be written, before any work. @throws OutputError OUTPUT_EXISTS, OUTPUT_WRITE */
export function requirePlace(output: string, overwrite: boolean): void {
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
