import { type ChildProcessByStdio, spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { createInterface } from "node:readline";
import type { Readable, Writable } from "node:stream";
import { type Fault, GromaError } from "@groma/georef";
import { installedCore, isClone, platform } from "../installed/parts.js";

/** The converter core, the file system or the points made a command fail; the code says which. */
export class CoreError extends GromaError {
  static override readonly kind = "CoreError";
}

/** Path of the converter core: that of this installation, or the one that GROMA_CORE names. */
export const coreProgram = process.env.GROMA_CORE || installedCore;

/** Answers a line of the core: what is written to its standard input, which then ends; or nothing. */
export type Answer<Line> = (line: Line, signal: AbortSignal) => Promise<string> | undefined;

/**
 * Runs the core to its end, giving each JSON line of its standard output to `onLine`. Where an answer cannot be made,
 * the core is stopped and leaves nothing behind.
 *
 * @param signal stops the core, which tidies up and says so
 * @throws CoreError with the core's own code, CORE_MISSING, CORE_FAILED; whatever the answer fails with
 */
export async function runCore<Line extends { readonly event?: string }>(
  args: readonly string[],
  onLine: Answer<Line>,
  signal?: AbortSignal,
): Promise<void> {
  signal?.throwIfAborted();
  if (!existsSync(coreProgram)) {
    throw coreMissing();
  }
  const child = spawn(coreProgram, args, { stdio: ["pipe", "pipe", "pipe"] });
  // The core may have ended by itself; then its own error tells why.
  child.stdin.on("error", () => undefined);
  const stop = () => void child.kill("SIGTERM");
  signal?.addEventListener("abort", stop);
  let fault: Fault | undefined;
  let complaint = "";
  child.stderr.on("data", (chunk: Buffer) => {
    complaint = (complaint + chunk.toString()).slice(-4096);
  });
  const closed = new Promise<number | null>((resolve, reject) => {
    child.on("error", reject);
    child.on("close", resolve);
  });
  // A process that is stopped ends its output; whoever reads must not wait for more.
  closed.catch(() => undefined);
  const answers = answerer(child);
  try {
    for await (const text of createInterface({ input: child.stdout })) {
      const line = JSON.parse(text) as Line;
      if (line.event === "error") fault = line as unknown as Fault;
      else answers.give(onLine(line, answers.signal));
    }
    const code = await closed;
    await answers.end();
    if (fault) throw new CoreError(fault);
    signal?.throwIfAborted();
    if (code !== 0) throw coreFailed(complaint.trim().split("\n").at(-1) || `exit code ${code}`);
  } finally {
    signal?.removeEventListener("abort", stop);
  }
}

function coreMissing(): CoreError {
  const [cause, fix] =
    process.env.GROMA_CORE || isClone
      ? ["the converter core is not built", "run npm run setup"]
      : [
          `there is no core for this platform (${platform}) in the installation`,
          `install @groma/core-${platform} of the same version, or build the core in Groma's sources with cargo build --release --manifest-path converter/Cargo.toml and name the file groma-core in GROMA_CORE`,
        ];
  return new CoreError({ code: "CORE_MISSING", file: coreProgram, cause: cause!, fix: fix! });
}

/** Answers the core when the answer is there, and stops it when it cannot be made. */
function answerer(child: ChildProcessByStdio<Writable, Readable, Readable>) {
  const controller = new AbortController();
  let ended = false;
  let failure: { readonly error: unknown } | undefined;
  let work: Promise<void> | undefined;
  return {
    /** Says that the core has ended without waiting for the answer. */
    signal: controller.signal,
    give(answer: Promise<string> | undefined): void {
      work ??= answer?.then(
        (text) => {
          child.stdin.end(`${text}\n`);
        },
        (error: unknown) => {
          if (ended) return;
          failure = { error };
          child.kill("SIGTERM");
        },
      );
    },
    /** @throws what the answer failed with, unless the core had failed before */
    async end(): Promise<void> {
      ended = true;
      controller.abort();
      await work;
      if (failure) throw failure.error;
    },
  };
}

/** The core did what it never should. */
export function coreFailed(cause: string): CoreError {
  return new CoreError({
    ...{ code: "CORE_FAILED", file: coreProgram, cause: `the converter core failed: ${cause}` },
    fix: "report this with the command and, if possible, the file",
  });
}
