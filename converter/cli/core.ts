import { type ChildProcess, type ChildProcessByStdio, spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { createInterface } from "node:readline";
import type { Readable, Writable } from "node:stream";
import { fileURLToPath } from "node:url";
import { type Fault, GromaError } from "@groma/georef";

/** The converter core, the file system or the points made a command fail; the code says which. */
export class CoreError extends GromaError {}

/** What `groma-core scan` tells of a file: its header and records as they stand, nothing interpreted. */
export interface Scan {
  readonly file: string;
  readonly fileSize: number;
  /** LAS version, e.g. `1.4`. */
  readonly version: string;
  readonly pointFormat: number;
  readonly points: number;
  /** Bytes per record. */
  readonly recordLength: number;
  readonly compressed: boolean;
  readonly copc: boolean;
  /** Source units per integer step. */
  readonly scale: readonly [number, number, number];
  readonly offset: readonly [number, number, number];
  /** Bounds as the header declares them, source units. */
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
  readonly systemIdentifier: string;
  readonly generatingSoftware: string;
  readonly creation: string | null;
  readonly extraBytes: readonly { readonly name: string; readonly type: string }[];
  readonly wkt?: string;
  readonly geoTiff?: { readonly directory: number[]; readonly doubles: number[]; readonly ascii: string };
  /** The records of user id `groma`: base64 of georeference and transformation, the statistics as they are. */
  readonly groma?: { readonly "1"?: string; readonly "2"?: ScanStatistics; readonly "3"?: string };
  readonly warnings: readonly string[];
}

/** The statistics record (docs/record.md). */
export interface ScanStatistics {
  readonly points: number;
  readonly rgbBits: 8 | 16 | null;
  readonly attributes: readonly { name: string; min: number; max: number; mean: number }[];
  readonly classes: Readonly<Record<string, number>>;
  readonly returns: Readonly<Record<string, number>>;
}

/** What a conversion tells while it runs. */
export type CoreEvent =
  | { readonly event: "progress"; readonly stage: string; readonly done: number; readonly total: number }
  | { readonly event: "warning"; readonly text: string };

/** Bounds of the points themselves, source units; the same that the output's header gets. */
export interface PointBounds {
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

/** Files of the records that are made while a conversion runs. */
export interface RecordFiles {
  readonly record: string;
  readonly transformation?: string | undefined;
}

/** Makes the records once the bounds are known; the signal says that the conversion has ended without them. */
export type RecordMaker = (bounds: PointBounds, signal: AbortSignal) => Promise<RecordFiles>;

/** What a conversion made. */
export interface Conversion {
  readonly points: number;
  readonly nodes: number;
  readonly bytes: number;
  readonly seconds: number;
}

type Line =
  | CoreEvent
  | ({ event: "bounds" } & PointBounds)
  | ({ event: "done" } & Conversion)
  | ({ event: "error" } & Fault);

const program = fileURLToPath(
  new URL(`../target/release/groma-core${process.platform === "win32" ? ".exe" : ""}`, import.meta.url),
);

/** Path of the converter core; what an older one made is made again. */
export const coreProgram = program;

/**
 * Header and records of a LAS or LAZ file.
 *
 * @throws CoreError INPUT_* when it is no such file
 */
export async function scanFile(file: string): Promise<Scan> {
  let scan: Scan | undefined;
  await run(["scan", file], (line) => {
    scan = line as unknown as Scan;
  });
  if (scan === undefined) throw broken("it said nothing of the file");
  return scan;
}

/**
 * Runs a conversion to its end. Where the records cannot be made, the core is stopped and leaves nothing behind.
 *
 * @param args arguments of `groma-core convert`
 * @throws CoreError INPUT_*, OUTPUT_*, OPTION_*, and whatever `makeRecords` throws
 */
export async function convertFiles(
  args: readonly string[],
  onEvent: (event: CoreEvent) => void,
  makeRecords: RecordMaker,
): Promise<Conversion> {
  let done: Conversion | undefined;
  const onLine = (line: Line) => {
    if (line.event === "done") done = line;
    else if (line.event === "progress" || line.event === "warning") onEvent(line);
  };
  await run(["convert", ...args, "--wait-for-record"], onLine, makeRecords);
  if (done === undefined) throw broken("it ended without a result");
  return done;
}

/** Runs the core, giving each JSON line of its standard output to `onLine`, and an answer to its bounds. */
async function run(
  args: readonly string[],
  onLine: (line: Line) => void,
  makeRecords?: RecordMaker,
): Promise<void> {
  if (!existsSync(program)) {
    throw new CoreError({
      ...{ code: "CORE_MISSING", file: program, cause: "the converter core is not built" },
      fix: "run npm run setup",
    });
  }
  const child = spawn(program, args, { stdio: ["pipe", "pipe", "pipe"] });
  // The core may have ended by itself; then its own error tells why.
  child.stdin.on("error", () => undefined);
  let fault: Fault | undefined;
  let complaint = "";
  child.stderr.on("data", (chunk: Buffer) => {
    complaint = (complaint + chunk.toString()).slice(-4096);
  });
  const release = passSignals(child);
  const closed = new Promise<number | null>((resolve, reject) => {
    child.on("error", reject);
    child.on("close", resolve);
  });
  // A process that is stopped ends its output; whoever reads must not wait for more.
  closed.catch(() => undefined);
  const answer = answerer(child, makeRecords);
  for await (const text of createInterface({ input: child.stdout })) {
    const line = JSON.parse(text) as Line;
    if (line.event === "error") fault = line;
    else if (line.event === "bounds") answer.begin(line);
    else onLine(line);
  }
  const code = await closed;
  release();
  await answer.end();
  if (fault) throw new CoreError(fault);
  if (code !== 0) throw broken(complaint.trim().split("\n").at(-1) || `it ended with ${code}`);
}

/** Answers the core when the records are made, and stops it when they cannot be. */
function answerer(child: ChildProcessByStdio<Writable, Readable, Readable>, makeRecords?: RecordMaker) {
  const controller = new AbortController();
  let ended = false;
  let failure: { readonly error: unknown } | undefined;
  let work: Promise<void> | undefined;
  return {
    begin(bounds: PointBounds): void {
      work = makeRecords?.(bounds, controller.signal).then(
        (files) => {
          child.stdin.end(`${JSON.stringify(files)}\n`);
        },
        (error: unknown) => {
          if (ended) return;
          failure = { error };
          child.kill("SIGTERM");
        },
      );
    },
    /** @throws what the records failed with, unless the core had failed before */
    async end(): Promise<void> {
      ended = true;
      controller.abort();
      await work;
      if (failure) throw failure.error;
    },
  };
}

/** The core hears of SIGINT and SIGTERM and tidies up; this process then ends by the core's error. */
function passSignals(child: ChildProcess): () => void {
  const handlers = (["SIGINT", "SIGTERM"] as const).map((signal) => {
    const handler = () => child.kill(signal);
    process.on(signal, handler);
    return () => process.off(signal, handler);
  });
  return () => {
    for (const off of handlers) off();
  };
}

function broken(cause: string): CoreError {
  return new CoreError({
    ...{ code: "CORE_FAILED", file: program, cause: `the converter core failed: ${cause}` },
    fix: "report this with the command and, if possible, the file",
  });
}
