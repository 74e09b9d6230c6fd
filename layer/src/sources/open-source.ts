import { SourceError } from "../errors/index.js";
import type { ReadOptions } from "./bytes/byte-source.js";
import { looksLikeHtml } from "./bytes/http-answer.js";
import type { HttpOptions } from "./bytes/http-source.js";
import { openBytes, type SourceLike } from "./bytes/open-bytes.js";
import type { PointSource } from "./contract/point-source.js";
import { CopcSource } from "./copc/copc-source.js";

/** The formats that are known; each tells its files by how they begin. A further one is a line here. */
const FORMATS = [CopcSource] as const;

/** What the workers can decode, as told by the sources. */
export type Encoding = Awaited<ReturnType<(typeof FORMATS)[number]["open"]>>["encoding"];

/** A data set in one of the formats that are known. */
export type OpenedSource = PointSource<unknown, Encoding>;

/** How a data set is opened. */
export interface OpenOptions extends HttpOptions, ReadOptions {}

export type { SourceLike } from "./bytes/open-bytes.js";

/** Bytes from the start by which formats are told apart. */
const OPENING = 64;

/**
 * Opens a data set in whatever format it is.
 * @param from an address, a `File` or `Blob`, or an own source of bytes
 * @throws SourceError, FormatError
 */
export async function openSource(from: SourceLike, options: OpenOptions = {}): Promise<OpenedSource> {
  const bytes = await openBytes(from, options);
  const { signal } = options;
  if (bytes.size === 0) throw emptyFile(bytes.name);
  const opening = await bytes.read(0, Math.min(OPENING, bytes.size ?? OPENING), { signal });
  if (looksLikeHtml(opening)) throw webPage(bytes.name);
  const format = FORMATS.find((candidate) => candidate.recognises(opening));
  // COPC's own words for what is none of all formats.
  return (format ?? CopcSource).open(bytes, { signal });
}

/**
 * Reads a file that belongs to a data set whole, as the data set itself is read.
 * @param most bytes that it may have
 * @throws SourceError; SOURCE_SIZE where it is longer, or its length is not told
 */
export async function readWhole(
  from: SourceLike,
  most: number,
  options: OpenOptions = {},
): Promise<{ readonly name: string; readonly bytes: Uint8Array }> {
  const source = await openBytes(from, options);
  const { name, size } = source;
  if (size === undefined || size > most) {
    throw new SourceError({
      ...{ code: "SOURCE_SIZE", file: name },
      cause:
        size === undefined ? "the server does not tell how long the file is" : `it is ${size} bytes long`,
      fix: "Check the address",
    });
  }
  const bytes = size === 0 ? new Uint8Array(0) : await source.read(0, size, { signal: options.signal });
  return { name, bytes };
}

function emptyFile(file: string): SourceError {
  return new SourceError({
    code: "SOURCE_EMPTY",
    file,
    cause: "the file is empty",
    fix: "Copy or convert the file again",
  });
}

function webPage(file: string): SourceError {
  return new SourceError({
    code: "SOURCE_HTML",
    file,
    cause: "this is an HTML page, not a point cloud",
    fix: "Check the address; a login or error page may stand in for the file",
  });
}
