import { makeZip } from "client-zip";
import type { ByteSink } from "./byte-sink.js";

/** A file in an archive. */
export interface ArchiveEntry {
  readonly name: string;
  readonly content: Uint8Array | Blob | string;
}

/**
 * Writes a ZIP archive file by file, as they come; files are stored as they are, so that all programs make the same bytes
 * of the same files. Archives beyond 4 GB, or 65,535 files, are ZIP64.
 * @param date of all files
 */
export async function writeArchive(
  entries: AsyncIterable<ArchiveEntry> | Iterable<ArchiveEntry>,
  sink: ByteSink,
  date: Date,
): Promise<void> {
  async function* files() {
    for await (const { name, content } of entries) {
      yield { name, lastModified: date, input: content as Uint8Array<ArrayBuffer> | Blob | string };
    }
  }
  const reader = makeZip(files()).getReader();
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) return;
      await sink.write(value);
    }
  } finally {
    // Lets go of what the entries hold, where the sink failed.
    await reader.cancel().catch(() => undefined);
  }
}
