import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";
import { setTimeout } from "node:timers/promises";

/** Takes a lock, which is a file, unless a process that still runs has it. Who took it removes it. */
export function taken(lock: string): boolean {
  try {
    writeFileSync(lock, String(process.pid), { flag: "wx" });
    return true;
  } catch {
    if (!holderRuns(lock)) rmSync(lock, { force: true });
    return false;
  }
}

function holderRuns(lock: string): boolean {
  try {
    const holder = Number(readFileSync(lock, "utf8"));
    // Until its number is written nobody stands there.
    return holder === 0 || process.kill(holder, 0);
  } catch (thrown) {
    return (thrown as NodeJS.ErrnoException).code !== "ESRCH";
  }
}

/** Works while no other process does that asks for the same lock; until then it waits. */
export async function locked<T>(lock: string, work: () => T | Promise<T>): Promise<T> {
  mkdirSync(dirname(lock), { recursive: true });
  while (!taken(lock)) await setTimeout(100);
  try {
    return await work();
  } finally {
    rmSync(lock);
  }
}
