import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { median } from "./measure.mjs";

/**
 * What `groma convert` takes beside its core: its start, the CRS, PROJ before the points are read, the summary. PROJ's fits
 * are made while the core builds.
 *
 * @param {string} root
 * @param {string} scan
 * @param {string} output written anew
 * @param {number} rounds
 * @returns {{ seconds: number, own: number }} all of it, and what is not the core's; medians
 */
export function ownTime(root, scan, output, rounds) {
  const args = ["convert", scan, output, "--overwrite", "--progress", "json"];
  const runs = Array.from({ length: rounds }, () => {
    const began = performance.now();
    const told = execFileSync(process.execPath, [join(root, "converter/bin/groma.mjs"), ...args], {
      encoding: "utf8",
    });
    const seconds = (performance.now() - began) / 1000;
    return { seconds, own: seconds - JSON.parse(told.trim().split("\n").at(-1)).seconds };
  });
  return { seconds: median(runs.map((run) => run.seconds)), own: median(runs.map((run) => run.own)) };
}
