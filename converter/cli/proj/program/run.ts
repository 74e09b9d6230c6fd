import { spawn } from "node:child_process";
import { ProjError } from "./errors.js";

/** What a program left behind. */
export interface Outcome {
  readonly status: number;
  readonly stdout: string;
  readonly stderr: string;
}

/** What one of PROJ's programs is run with. */
export interface RunOptions {
  readonly environment?: NodeJS.ProcessEnv | undefined;
  /** Written to the program's standard input. */
  readonly input?: string | undefined;
  readonly signal?: AbortSignal | undefined;
}

/** Longer than any answer of PROJ to a question asked here. */
const LIMIT_MILLISECONDS = 120_000;
/** Bytes of output after which a program is stopped: no honest answer is as long. */
const LIMIT_BYTES = 512 * 2 ** 20;

/**
 * Runs one program without a shell and waits for its end.
 *
 * @throws ProjError PROJ_MISSING when there is no such program, PROJ_FAILED when it does not end or never stops writing
 */
export function run(program: string, args: readonly string[], options: RunOptions = {}): Promise<Outcome> {
  // Not the timer of `spawn`: that goes on, and keeps this process alive, where there is no such program.
  const limit = AbortSignal.timeout(LIMIT_MILLISECONDS);
  return new Promise((resolve, reject) => {
    const child = spawn(program, args, {
      stdio: ["pipe", "pipe", "pipe"],
      killSignal: "SIGKILL",
      ...(options.environment ? { env: options.environment } : {}),
      signal: options.signal ? AbortSignal.any([options.signal, limit]) : limit,
    });
    const collected: Record<"stdout" | "stderr", Buffer[]> = { stdout: [], stderr: [] };
    let bytes = 0;
    let flooded = false;
    for (const name of ["stdout", "stderr"] as const) {
      child[name].on("data", (chunk: Buffer) => {
        bytes += chunk.length;
        if (bytes <= LIMIT_BYTES) collected[name].push(chunk);
        else if (!flooded) flooded = child.kill("SIGKILL");
      });
    }
    // A program that ends before it has read everything breaks the pipe; its exit status tells why.
    child.stdin.on("error", () => {});
    child.stdin.end(options.input ?? "");
    child.on("error", (error: NodeJS.ErrnoException) => {
      if (options.signal?.aborted) reject(options.signal.reason);
      else if (limit.aborted) reject(failed(program, `gave no answer in ${LIMIT_MILLISECONDS / 1000} s`));
      else reject(error.code === "ENOENT" || error.code === "EACCES" ? missing(program, error.code) : error);
    });
    child.on("close", (status, signal) => {
      if (status === null) {
        const why = flooded ? "wrote more than any answer needs" : `was ended by ${signal ?? "a signal"}`;
        reject(failed(program, why));
        return;
      }
      const text = (name: "stdout" | "stderr") => Buffer.concat(collected[name]).toString("utf8");
      resolve({ status, stdout: text("stdout"), stderr: text("stderr") });
    });
  });
}

function missing(program: string, code: string): ProjError {
  return new ProjError({
    code: "PROJ_MISSING",
    file: program,
    cause: code === "ENOENT" ? "program not found" : "no permission to execute the program",
    fix: "install PROJ (Debian: converter/scripts/install-proj, Homebrew: proj), or convert with --engine proj4js",
  });
}

/** A program that gave no answer; `why` is a clause without a closing stop. */
export function failed(program: string, why: string): ProjError {
  return new ProjError({
    code: "PROJ_FAILED",
    file: program,
    cause: why,
    fix: "run it by hand to see what is wrong with the PROJ installation, or convert with --engine proj4js",
  });
}
