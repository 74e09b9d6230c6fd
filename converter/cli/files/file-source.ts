import { type FileHandle, open } from "node:fs/promises";
import type { ByteSource } from "@groma/layer/sources";

/** A file of this machine as a source of bytes. */
export class FileSource implements ByteSource {
  readonly name: string;
  readonly size: number;
  readonly #file: FileHandle;

  private constructor(name: string, size: number, file: FileHandle) {
    this.name = name;
    this.size = size;
    this.#file = file;
  }

  static async open(path: string): Promise<FileSource> {
    const file = await open(path);
    return new FileSource(path, (await file.stat()).size, file);
  }

  /** @throws RangeError where the file ends before */
  async read(begin: number, end: number): Promise<Uint8Array> {
    const bytes = await this.upTo(begin, end);
    if (bytes.length < end - begin) throw new RangeError(`${this.name} ends before byte ${end}`);
    return bytes;
  }

  /** The bytes of a range as far as the file has them. */
  async upTo(begin: number, end: number): Promise<Uint8Array> {
    const bytes = new Uint8Array(Math.max(0, Math.min(end, this.size) - begin));
    let filled = 0;
    while (filled < bytes.length) {
      const { bytesRead } = await this.#file.read(bytes, filled, bytes.length - filled, begin + filled);
      if (bytesRead === 0) break;
      filled += bytesRead;
    }
    return bytes.subarray(0, filled);
  }

  async close(): Promise<void> {
    await this.#file.close();
  }
}
