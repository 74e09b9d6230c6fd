import { SourceError } from "../../errors/index.js";
import { BlobSource } from "./blob-source.js";
import { type ByteSource, isByteSource, type ReadOptions } from "./byte-source.js";
import type { AddressFunction } from "./credentials.js";
import { type HttpOptions, HttpSource } from "./http-source.js";

/**
 * Whatever a data set can be opened from: an address, a function that gives a signed one and renews it, a file the user
 * chose, or an own source of bytes.
 */
export type SourceLike = string | URL | AddressFunction | Blob | ByteSource;

/**
 * Opens the bytes behind an address, a Blob or a source. For an address this makes the opening request.
 * @throws SourceError; SOURCE_ADDRESS, before any request, for what is no address
 */
export async function openBytes(
  from: SourceLike,
  options: HttpOptions & ReadOptions = {},
): Promise<ByteSource> {
  if (isByteSource(from)) return from;
  if (from instanceof Blob) return new BlobSource(from);
  return HttpSource.open(typeof from === "function" ? from : addressOf(from), options, {
    signal: options.signal,
  });
}

/** Schemes that a page can fetch bytes from. */
const FETCHED = ["http:", "https:", "blob:", "data:"];

/** @throws SourceError SOURCE_ADDRESS */
function addressOf(from: unknown): string {
  const text = typeof from === "string" || from instanceof URL ? String(from).trim() : "";
  const scheme = /^[a-z][a-z0-9+.-]*:/i.exec(text)?.[0].toLowerCase();
  if (text !== "" && (scheme === undefined || FETCHED.includes(scheme))) return text;
  const what = scheme ? `addresses with ${scheme} cannot be read` : "there is no address of a point cloud";
  throw new SourceError({
    code: "SOURCE_ADDRESS",
    file: text === "" ? String(from) : text,
    cause: what,
    fix: "Give an http or https address, a File or Blob, or a source of bytes",
  });
}
