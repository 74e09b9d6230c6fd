import { type FileHandle, open } from "node:fs/promises";
import type { BlockStore } from "@groma/layer/export";

interface Block {
  readonly at: number;
  readonly length: number;
}

/** Keeps blocks in a file, which is the caller's to remove. */
export class BlockFile implements BlockStore {
  readonly #file: FileHandle;
  #length = 0;

  private constructor(file: FileHandle) {
    this.#file = file;
  }

  static async create(path: string): Promise<BlockFile> {
    return new BlockFile(await open(path, "wx+"));
  }

  async put(bytes: Uint8Array): Promise<Block> {
    const block = { at: this.#length, length: bytes.length };
    this.#length += bytes.length;
    for (let done = 0; done < bytes.length; ) {
      done += (await this.#file.write(bytes, done, bytes.length - done, block.at + done)).bytesWritten;
    }
    return block;
  }

  async get(block: unknown): Promise<Uint8Array> {
    const { at, length } = block as Block;
    const bytes = new Uint8Array(length);
    for (let done = 0; done < length; ) {
      const { bytesRead } = await this.#file.read(bytes, done, length - done, at + done);
      if (bytesRead === 0) throw new Error("the scratch file is shorter than it was");
      done += bytesRead;
    }
    return bytes;
  }

  async close(): Promise<void> {
    await this.#file.close();
  }
}
