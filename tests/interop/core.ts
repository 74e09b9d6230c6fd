import { type ChildProcess, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { projectRoot } from "../project.js";

/** The converter core under test; `GROMA_CORE` names another build of it. */
export const coreBinary = process.env.GROMA_CORE ?? join(projectRoot, "converter/target/release/groma-core");

/** Why tests of the converter core are skipped; undefined where it is built. */
export const coreMissing = existsSync(coreBinary)
  ? undefined
  : `${coreBinary} is not built: run npm run setup`;

/** One of the JSON lines that `groma-core convert` prints. */
export interface CoreEvent {
  event: "progress" | "warning" | "bounds" | "plan" | "done" | "error";
  code?: string;
  cause?: string;
  file?: string;
  fix?: string;
  text?: string;
  points?: number;
}

/** How a run of the core ended. */
export interface Outcome {
  status: number | null;
  /** The signal that ended it: a crash, or the time limit (SIGKILL). */
  signal: string | null;
  events: CoreEvent[];
  /** Standard error. */
  complaint: string;
}

/** Limits of a run. */
export interface Limits {
  /** Milliseconds; then it counts as hung and is killed. */
  readonly timeout?: number;
  /** MiB of address space (Linux). */
  readonly memory?: number;
  /** KiB that one file may have; what goes beyond fails as on a full disk. */
  readonly fileSize?: number;
  readonly env?: Readonly<Record<string, string>>;
  /** Called with the process as soon as it runs. */
  readonly onStart?: (child: ChildProcess) => void;
}

/** Runs `groma-core` to its end. */
export function runCore(args: readonly string[], limits: Limits = {}): Promise<Outcome> {
  const { timeout = 60_000, memory, fileSize, env, onStart } = limits;
  const bounds = [
    ...(memory === undefined || process.platform !== "linux" ? [] : [`ulimit -v ${memory * 1024}`]),
    // A write beyond the limit shall fail instead of ending the process.
    ...(fileSize === undefined ? [] : ["trap '' XFSZ", `ulimit -f ${fileSize * 2}`]),
  ];
  const command: [string, string[]] =
    bounds.length === 0
      ? [coreBinary, [...args]]
      : ["sh", ["-c", [...bounds, 'exec "$0" "$@"'].join("; "), coreBinary, ...args]];
  return new Promise((resolve, reject) => {
    const child = spawn(...command, {
      stdio: ["ignore", "pipe", "pipe"],
      env: { ...process.env, ...env },
      timeout,
      killSignal: "SIGKILL",
    });
    let [output, complaint] = ["", ""];
    child.stdout.setEncoding("utf8").on("data", (text: string) => {
      output += text;
    });
    child.stderr.setEncoding("utf8").on("data", (text: string) => {
      complaint += text;
    });
    child.on("error", reject);
    child.on("close", (status, signal) => {
      const lines = output.split("\n").filter((line) => line.endsWith("}"));
      resolve({ status, signal, events: lines.map((line) => JSON.parse(line) as CoreEvent), complaint });
    });
    onStart?.(child);
  });
}

/** Runs `groma-core convert`. */
export const convert = (args: readonly string[], limits?: Limits): Promise<Outcome> =>
  runCore(["convert", ...args], limits);

/** Does pieces of work in order, two at a time; the results are in the order of the work. */
export async function inPairs<T, R>(items: readonly T[], work: (item: T) => Promise<R>): Promise<R[]> {
  const results: R[] = new Array(items.length);
  let next = 0;
  const worker = async () => {
    while (next < items.length) {
      const index = next++;
      results[index] = await work(items[index]!);
    }
  };
  await Promise.all([worker(), worker()]);
  return results;
}

/** A folder for one file of tests; the caller removes it. */
export const makeFolder = (): string => mkdtempSync(join(tmpdir(), "groma-interop-"));

/** Calls back with a folder of its own and removes it afterwards. */
export async function withFolder<T>(work: (folder: string) => T | Promise<T>): Promise<T> {
  const folder = makeFolder();
  try {
    return await work(folder);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

/** Names of all files of a folder, hidden ones too. */
export const filesOf = (folder: string): string[] => readdirSync(folder).sort();
