import { type FileHandle, open, rename } from "node:fs/promises";
import { dirname, join } from "node:path";
import type { ByteSink } from "@groma/layer/export";
import { withScratch } from "../core/scratch.js";
import { OutputError, requirePlace } from "../given/output-place.js";

/** A file of this machine as a sink. */
class FileSink implements ByteSink {
  readonly #file: FileHandle;

  constructor(file: FileHandle) {
    this.#file = file;
  }

  async write(bytes: Uint8Array): Promise<void> {
    await this.#file.appendFile(bytes);
  }

  async overwrite(at: number, bytes: Uint8Array): Promise<void> {
    let done = 0;
    while (done < bytes.length) {
      done += (await this.#file.write(bytes, done, bytes.length - done, at + done)).bytesWritten;
    }
  }
}

/**
 * Has a file written beside its place and then renamed: it stands whole or not at all.
 *
 * @param fill writes it; false says that there is nothing to be kept
 * @throws OutputError OUTPUT_EXISTS, OUTPUT_WRITE; ScratchError; what `fill` throws
 */
export async function writeWhole(
  output: string,
  overwrite: boolean,
  fill: (unfinished: string) => Promise<void>,
): Promise<void> {
  await withScratch(dirname(output), async (folder) => {
    const unfinished = join(folder, "output");
    try {
      await fill(unfinished);
      // That it is none of the files that are read was found before the work.
      requirePlace(output, overwrite, []);
      await rename(unfinished, output);
    } catch (error) {
      if (!(error instanceof Error && "syscall" in error)) throw error;
      throw new OutputError({
        ...{ code: "OUTPUT_WRITE", file: output, cause: `it cannot be written (${error.message})` },
        fix: "free some space, or name another output",
      });
    }
  });
}

/** Has a file written through a sink and made durable. @throws errors of the system; what `fill` throws */
export async function writeFile<T>(path: string, fill: (sink: ByteSink) => Promise<T>): Promise<T> {
  const file = await open(path, "wx+");
  try {
    const result = await fill(new FileSink(file));
    await file.sync();
    return result;
  } finally {
    await file.close();
  }
}
