import { mkdtemp, readdir, rm, statfs } from "node:fs/promises";
import { hostname } from "node:os";
import { join } from "node:path";
import { GromaError } from "@groma/georef";

/** There is no room for temporary files. Codes: TEMP_SPACE, TEMP_DIR. */
class ScratchError extends GromaError {
  static override readonly kind = "ScratchError";
}

/** Names of the folders of this machine, before the number of the process. */
const PREFIX = `.groma_scratch-${hostname().replace(/[^A-Za-z0-9]/g, "")}-`;

/**
 * Work with a temporary folder of its own, which is gone afterwards however the work ends. What a process that was
 * killed has left behind in the same place is removed first.
 *
 * @param parent folder that the temporary one is made in
 * @throws ScratchError TEMP_DIR when the parent takes no folder
 */
export async function withScratch<T>(parent: string, work: (folder: string) => Promise<T>): Promise<T> {
  let folder: string;
  try {
    await removeLeftovers(parent);
    folder = await mkdtemp(join(parent, `${PREFIX}${process.pid}-`));
  } catch (error) {
    throw new ScratchError({
      code: "TEMP_DIR",
      file: parent,
      cause: `no temporary folder can be created in it (${error instanceof Error ? error.message : error})`,
      fix: "name another folder with --temp-dir",
    });
  }
  try {
    return await work(folder);
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
}

async function removeLeftovers(parent: string): Promise<void> {
  for (const name of await readdir(parent)) {
    const pid = name.startsWith(PREFIX) ? Number.parseInt(name.slice(PREFIX.length), 10) : Number.NaN;
    if (Number.isInteger(pid) && !isAlive(pid))
      await rm(join(parent, name), { recursive: true, force: true });
  }
}

function isAlive(pid: number): boolean {
  try {
    process.kill(pid, 0);
    return true;
  } catch (error) {
    // A process of somebody else is one.
    return error instanceof Error && "code" in error && error.code === "EPERM";
  }
}

/** Bytes that are free in a folder. */
export async function freeBytes(folder: string): Promise<number> {
  const { bavail, bsize } = await statfs(folder);
  return bavail * bsize;
}

/** @throws ScratchError TEMP_SPACE when a folder has less than `needed` bytes free */
export async function requireSpace(folder: string, needed: number): Promise<void> {
  const free = await freeBytes(folder);
  if (free >= needed) return;
  throw new ScratchError({
    code: "TEMP_SPACE",
    file: folder,
    cause: `temporary files need ${needed} bytes, ${free} are free`,
    fix: "free some space, or name another folder with --temp-dir",
  });
}
