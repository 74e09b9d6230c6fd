import { GromaError } from "@groma/georef";

/**
 * A scan cannot be indexed in the page. Codes start with `INDEX_`; those with `INPUT_` are the core's own, and SOURCE_CHANGED
 * is that of files that can no longer be read.
 */
export class IndexError extends GromaError {
  static override readonly kind = "IndexError";
}

/** Of a file that was written to or taken away since the reader chose it. @param reason name of the browser's error */
export function changed(file: string, reason: string): IndexError {
  return new IndexError({
    code: "SOURCE_CHANGED",
    file,
    cause: `the file can no longer be read (${reason})`,
    fix: "Choose the file again",
  });
}
