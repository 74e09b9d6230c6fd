import { execFile } from "node:child_process";
import { readFileSync, rmSync, statSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";

const script = join(dirname(fileURLToPath(import.meta.url)), "measure.py");

/**
 * Runs a command once.
 *
 * @param {string} python
 * @param {string} scratch folder for the command's temporary files, watched
 * @param {string[]} command
 * @param {string} output the file that the command writes; removed afterwards
 * @returns {Promise<{ seconds: number, cpu: number, peak: number, scratch: number, bytes: number }>} bytes of memory,
 *   of temporary files and of the output
 * @throws {Error} with what the command printed last, when it fails
 */
export async function measure(python, scratch, command, output) {
  rmSync(output, { force: true });
  const { stdout } = await promisify(execFile)(python, [script, scratch, ...command]);
  const { code, ...taken } = JSON.parse(stdout);
  if (code !== 0) {
    const said = readFileSync(join(scratch, "../measure.log"), "utf8").slice(-2000);
    throw new Error(`${command.join(" ")} ended with ${code}: ${said}`);
  }
  const bytes = statSync(output).size;
  rmSync(output);
  return { ...taken, bytes };
}

/** The middle value; of an even number of values the lower of the two. */
export function median(values) {
  return [...values].sort((a, b) => a - b)[(values.length - 1) >> 1];
}

/** Medians of runs, field by field; the peak and the scratch space are the largest. */
export function summary(runs) {
  const of = (field) => runs.map((run) => run[field]);
  return {
    runs: runs.length,
    seconds: median(of("seconds")),
    cpu: median(of("cpu")),
    peak: Math.max(...of("peak")),
    scratch: Math.max(...of("scratch")),
    bytes: median(of("bytes")),
  };
}
