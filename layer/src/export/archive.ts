import { crc32 } from "../sources/contract/checksum.js";
import { BlockSink, type ByteSink, GATHERED } from "./byte-sink.js";
import { type ZipFile, zipDescriptor, zipDirectory, zipHeader } from "./zip.js";

/** A file in an archive. */
export interface ArchiveEntry {
  readonly name: string;
  /** Is the caller's again once the next file is asked for. */
  readonly content: Uint8Array | string;
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
  // Of many small files: one wait for some megabyte, not several for each.
  const block = new BlockSink();
  const files: ZipFile[] = [];
  let before = 0;
  const flush = async () => {
    before += block.length;
    await sink.write(block.bytes());
    block.clear();
  };
  for await (const { name, content } of entries) {
    const bytes = typeof content === "string" ? new TextEncoder().encode(content) : content;
    const file = { name, at: before + block.length, size: bytes.length, checksum: crc32(bytes) };
    files.push(file);
    block.append(zipHeader(name, date));
    if (bytes.length < GATHERED) block.append(bytes);
    else {
      await flush();
      await sink.write(bytes);
      before += bytes.length;
    }
    block.append(zipDescriptor(file));
    if (block.length >= GATHERED) await flush();
  }
  for (const bytes of zipDirectory(files, before + block.length, date)) block.append(bytes);
  await flush();
}
