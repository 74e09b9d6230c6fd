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
 * @throws SourceError
 */
export async function openBytes(
  from: SourceLike,
  options: HttpOptions & ReadOptions = {},
): Promise<ByteSource> {
  if (isByteSource(from)) return from;
  if (from instanceof Blob) return new BlobSource(from);
  return HttpSource.open(typeof from === "function" ? from : String(from), options, {
    signal: options.signal,
  });
}
