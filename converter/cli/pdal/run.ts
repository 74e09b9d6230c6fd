import { spawn } from "node:child_process";
import { PdalError } from "./errors.js";

/** What a run of PDAL came to. */
export interface Outcome {
  readonly status: number;
  readonly stdout: string;
  readonly stderr: string;
}

/** Characters of output that are kept: metadata of thousands of stages and no more. */
const LONGEST_OUTPUT = 1 << 26;

/**
 * Runs PDAL without a shell and waits for its end.
 *
 * @param input written to its standard input
 * @param signal ends it at once: all that it leaves behind are files that its caller removes
 * @throws PdalError PDAL_MISSING when the program cannot be started, PDAL_FAILED when it is ended by a signal;
 * the reason of `signal`
 */
export function runPdal(
  program: string,
  args: readonly string[],
  input: string,
  signal?: AbortSignal,
): Promise<Outcome> {
  signal?.throwIfAborted();
  return new Promise((resolve, reject) => {
    const child = spawn(program, args, { stdio: ["pipe", "pipe", "pipe"] });
    const kill = () => void child.kill("SIGKILL");
    signal?.addEventListener("abort", kill);
    const text = { stdout: "", stderr: "" };
    for (const name of ["stdout", "stderr"] as const) {
      child[name].setEncoding("utf8").on("data", (chunk: string) => {
        if (text[name].length < LONGEST_OUTPUT) text[name] += chunk;
      });
    }
    // It may end before it has read everything; its exit status tells why.
    child.stdin.on("error", () => undefined);
    child.stdin.end(input);
    child.on("error", (error: NodeJS.ErrnoException) => {
      signal?.removeEventListener("abort", kill);
      reject(missing(program, error.code === "ENOENT" ? "program not found" : error.message));
    });
    child.on("close", (status, endedBy) => {
      signal?.removeEventListener("abort", kill);
      if (signal?.aborted) reject(signal.reason);
      else if (status === null) reject(failed(program, `PDAL was ended by ${endedBy ?? "a signal"}`));
      else resolve({ status, ...text });
    });
  });
}

/** @param cause a clause without a closing stop */
export function failed(file: string, cause: string): PdalError {
  return new PdalError({
    ...{ code: "PDAL_FAILED", file, cause },
    fix: "run pdal info on the file to see what is wrong with it or with PDAL",
  });
}

/** What PDAL complained of, in one line. */
export function complaint({ stdout, stderr, status }: Outcome): string {
  const lines = `${stderr}\n${stdout}`.split(/\r?\n/).map((line) => line.replace(/^PDAL: /, "").trim());
  return lines.find((line) => line !== "")?.replace(/\.$/, "") ?? `PDAL ended with ${status}`;
}

/** How PDAL is had on this platform. */
function howToInstall(): string {
  switch (process.platform) {
    case "darwin":
      return "brew install pdal";
    case "win32":
      return "conda install -c conda-forge pdal";
    default:
      return "Debian: converter/scripts/install-pdal of Groma; Ubuntu: apt install pdal; else conda install -c conda-forge pdal";
  }
}

/** @param cause a clause without a closing stop */
export function missing(file: string, cause: string): PdalError {
  return new PdalError({
    ...{ code: "PDAL_MISSING", file, cause },
    fix: `install PDAL (${howToInstall()}), or name its program with --pdal or GROMA_PDAL`,
  });
}
