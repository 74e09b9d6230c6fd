import { GromaError } from "@groma/georef";
import { RecordedPoints } from "@groma/layer/query";
import { FileSource } from "./file-source.js";
import { lazPerf } from "./laz-perf.js";

/** A file cannot be opened. Codes: INPUT_NOT_FOUND, INPUT_READ, as the core has them. */
class InputFileError extends GromaError {
  static override readonly kind = "InputFileError";
}

/** Points of a file that is open. */
export interface OpenedPoints {
  readonly points: RecordedPoints;
  close(): Promise<void>;
}

/** An address that is read by Range requests. */
const isAddress = (input: string): boolean => /^https?:\/\//i.test(input);

/**
 * Opens a COPC file of this machine or of a server.
 * @throws InputFileError, SourceError, FormatError; the signal's reason when aborted
 */
export async function openPoints(input: string, signal: AbortSignal): Promise<OpenedPoints> {
  if (isAddress(input)) {
    const points = await RecordedPoints.open(input, { createLazPerf: lazPerf, signal });
    return { points, close: async () => undefined };
  }
  const file = await FileSource.open(input).catch((error: NodeJS.ErrnoException) => {
    const missing = error.code === "ENOENT";
    throw new InputFileError({
      ...{ code: missing ? "INPUT_NOT_FOUND" : "INPUT_READ", file: input },
      cause: missing ? "there is no such file" : `it cannot be read (${error.code})`,
      fix: "name a COPC file of this machine, or its address",
    });
  });
  try {
    const points = await RecordedPoints.open(file, { createLazPerf: lazPerf, signal });
    return { points, close: () => file.close() };
  } catch (error) {
    await file.close();
    throw error;
  }
}
