import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { projectRoot } from "../project.js";

const binary = join(projectRoot, "converter/target/release/groma-core");

/** Why tests of the converter core are skipped; undefined where it is built. */
export const coreMissing = existsSync(binary) ? undefined : "groma-core is not built: run npm run setup";

/** One of the JSON lines that `groma-core convert` prints. */
export interface CoreEvent {
  event: "progress" | "warning" | "done" | "error";
  code?: string;
  points?: number;
}

/** Runs `groma-core convert` and returns its exit status and what it printed. */
export function convert(args: readonly string[]): { status: number | null; events: CoreEvent[] } {
  const { status, stdout } = spawnSync(binary, ["convert", ...args], { encoding: "utf8", timeout: 120_000 });
  const lines = stdout.split("\n").filter((line) => line !== "");
  return { status, events: lines.map((line) => JSON.parse(line) as CoreEvent) };
}

/** Calls back with a folder of its own and removes it afterwards. */
export function withFolder<T>(work: (folder: string) => T): T {
  const folder = mkdtempSync(join(tmpdir(), "groma-interop-"));
  try {
    return work(folder);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

/** Names of all files of a folder, hidden ones too. */
export const filesOf = (folder: string): string[] => readdirSync(folder).sort();
