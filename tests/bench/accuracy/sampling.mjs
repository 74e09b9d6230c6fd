import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** Rounds of conversions in which all strategies take turns. */
export const ROUNDS = 2;

/** Options of the converter by the name that a strategy has in the report. */
export const STRATEGIES = {
  poisson: "--sampling,poisson",
  grid: "--sampling,grid",
  random: "--sampling,random",
  first: "--sampling,first",
};

/** Measured for its time and size only: it takes the same points as `poisson`. */
export const AVERAGED = "poisson, mean colours";

const WAYS = { ...STRATEGIES, [AVERAGED]: "--sampling,poisson,--average-colors" };

/** The converter's default. */
export const CHOSEN = "poisson";

/** A file's samples, see sampling/measure.py: outside readers, no code of this project. */
export function measure(root, file, ...options) {
  return python(root, "measure.py", file, ...options);
}

/**
 * Converts autzen.laz by every strategy and measures the samples.
 *
 * @param {string} core the converter's binary
 * @returns {{ strategy: string, wall: number, cpu: number, peak: number, bytes: number, samples?: object }[] | undefined}
 *   seconds and bytes; undefined where the scan is not there
 */
export function measureSampling(root, core = join(root, "converter/target/release/groma-core")) {
  const scan = join(root, "../shared/data/autzen.laz");
  if (!existsSync(scan)) return undefined;
  const folder = mkdtempSync(join(tmpdir(), "groma-sampling-"));
  try {
    const ways = Object.entries(WAYS).map(([name, options]) => `${name}=${options}`);
    const converted = python(root, "convert.py", core, scan, folder, String(ROUNDS), ...ways);
    return Object.entries(converted).map(([strategy, cost]) => {
      const file = join(folder, `${strategy}.copc.laz`);
      if (!(strategy in STRATEGIES)) return { strategy, ...cost };
      const samples = measure(root, file, ...(strategy === CHOSEN ? ["--prefix"] : []));
      return { strategy, ...cost, samples };
    });
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

/** What a script of the folder sampling prints. */
function python(root, script, ...args) {
  const program = join(root, "tests/.venv/bin/python");
  const path = join(root, "tests/bench/accuracy/sampling", script);
  const stdio = ["ignore", "pipe", "inherit"];
  return JSON.parse(execFileSync(program, [path, ...args], { stdio, maxBuffer: 1 << 28 }));
}
