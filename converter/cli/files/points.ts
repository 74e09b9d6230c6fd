import { GromaError } from "@groma/georef";
import { RecordedPoints } from "@groma/layer/query";
import { type OpenedSource, openSource } from "@groma/layer/sources";
import { FileSource } from "./file-source.js";
import { lazBytes } from "./laz.js";

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
export const isAddress = (input: string): boolean => /^https?:\/\//i.test(input);

/**
 * Opens a COPC file of this machine or of a server.
 * @throws InputFileError, SourceError, FormatError; the signal's reason when aborted
 */
export async function openPoints(input: string, signal: AbortSignal): Promise<OpenedPoints> {
  return withBytes(input, async (from, close) => {
    const points = await RecordedPoints.open(from, { loadLaz: lazBytes, signal });
    return { points, close };
  });
}

/**
 * What a COPC file of this machine or of a server says of itself: its header, its records and the first page of its
 * hierarchy are read, no points.
 * @throws InputFileError, SourceError, FormatError; the signal's reason when aborted
 */
export async function readHead(input: string, signal: AbortSignal): Promise<OpenedSource> {
  return withBytes(input, async (from, close) => {
    const source = await openSource(from, { signal });
    await close();
    return source;
  });
}

/** Opens a file or leaves an address as it is; the file is closed where the use of it fails. */
async function withBytes<T>(
  input: string,
  use: (from: string | FileSource, close: () => Promise<void>) => Promise<T>,
): Promise<T> {
  if (isAddress(input)) return use(input, async () => undefined);
  const file = await FileSource.open(input).catch((error: NodeJS.ErrnoException) => {
    const missing = error.code === "ENOENT";
    throw new InputFileError({
      ...{ code: missing ? "INPUT_NOT_FOUND" : "INPUT_READ", file: input },
      cause: missing ? "there is no such file" : `it cannot be read (${error.code})`,
      fix: "name a COPC file of this machine, or its address",
    });
  });
  try {
    return await use(file, () => file.close());
  } catch (error) {
    await file.close();
    throw error;
  }
}
