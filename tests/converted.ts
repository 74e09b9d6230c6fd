import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, rmSync, statSync } from "node:fs";
import { join, parse } from "node:path";
import { taken } from "./lock.js";
import { projectRoot } from "./project.js";

const groma = join(projectRoot, "converter/dist/main.js");
const core = join(projectRoot, "converter/target/release/groma-core");
const folder = join(projectRoot, "tests/artifacts/copc");

/**
 * The COPC file that `groma convert` makes of a scan; made again only when the converter is newer than the result. Tests
 * of several processes ask for it, of which one makes it and the others wait.
 *
 * @returns absolute path
 * @throws Error with what the command printed, when it fails
 */
export function converted(scan: string): string {
  const output = join(folder, `${parse(scan).name}.copc.laz`);
  const lock = `${output}.lock`;
  const newest = Math.max(...[groma, core, scan].map((file) => statSync(file).mtimeMs));
  const there = () => existsSync(output) && statSync(output).mtimeMs > newest;
  mkdirSync(folder, { recursive: true });
  while (!there()) {
    if (!taken(lock)) {
      Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 100);
      continue;
    }
    try {
      if (!there()) convert(scan, output);
    } finally {
      rmSync(lock);
    }
  }
  return output;
}

/** Runs `groma convert`. @throws Error with what the command printed, when it fails */
export function convert(scan: string, output: string, options: readonly string[] = []): void {
  const args = [groma, "convert", scan, output, "--overwrite", "--progress", "json", ...options];
  execFileSync(process.execPath, args, { stdio: "pipe" });
}
