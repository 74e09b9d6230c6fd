import { SourceError } from "../../errors/index.js";
import { type ByteSource, checkRange, type ReadOptions } from "./byte-source.js";

/** A `File` that the user chose, or any `Blob`. */
export class BlobSource implements ByteSource {
  readonly name: string;
  readonly size: number;
  readonly #blob: Blob;

  /**
   * @param name for messages; default: the file's own, or `file`
   * @throws SourceError SOURCE_ADDRESS for what is no Blob
   */
  constructor(blob: Blob, name?: string) {
    if (!(blob instanceof Blob)) {
      throw new SourceError({
        code: "SOURCE_ADDRESS",
        file: name ?? String(blob),
        cause: "this is no File or Blob",
        fix: "Give the File that the user chose, or a Blob",
      });
    }
    this.#blob = blob;
    this.name = name ?? ("name" in blob && typeof blob.name === "string" ? blob.name : "file");
    this.size = blob.size;
  }

  async read(begin: number, end: number, options: ReadOptions = {}): Promise<Uint8Array> {
    checkRange(begin, end, this.size, this.name);
    options.signal?.throwIfAborted();
    let buffer: ArrayBuffer;
    try {
      buffer = await this.#blob.slice(begin, end).arrayBuffer();
    } catch (thrown) {
      // Browsers reject with NotReadableError once the file on disk was written to or removed.
      throw new SourceError({
        code: "SOURCE_CHANGED",
        file: this.name,
        cause: `the file can no longer be read (${thrown instanceof Error ? thrown.name : "unknown"})`,
        fix: "Choose the file again",
      });
    }
    options.signal?.throwIfAborted();
    return new Uint8Array(buffer);
  }
}
