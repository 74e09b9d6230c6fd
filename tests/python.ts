import { execFileSync } from "node:child_process";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { projectRoot } from "./project.js";

const python = process.env.GROMA_PYTHON ?? join(projectRoot, "tests/.venv/bin/python");

/** Why tests with Python referees are skipped; undefined where the set-up made their environment. */
export const pythonMissing = existsSync(python)
  ? undefined
  : `${python} is not there: run npm run setup -- --test`;

/** Seconds that a referee may take; more for long runs on a busy machine. */
const PATIENCE = Number(process.env.GROMA_PATIENCE ?? 280);

/** Runs a script of the tests with the referees at hand and parses the JSON that it prints. */
export function runPython<T>(script: string, args: readonly string[], input?: string): T {
  const output = execFileSync(python, [join(projectRoot, "tests", script), ...args], {
    encoding: "utf8",
    maxBuffer: 1 << 28,
    timeout: 1000 * PATIENCE,
    ...(input === undefined ? {} : { input }),
  });
  return JSON.parse(output) as T;
}
