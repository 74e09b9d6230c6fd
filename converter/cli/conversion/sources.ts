import { lstatSync } from "node:fs";
import { open, stat } from "node:fs/promises";
import { availableParallelism } from "node:os";
import type { Fault } from "@groma/georef";
import { CoreError, type Scan, scanFile } from "../core/core.js";
import type { Job } from "../pdal/pipeline.js";
import { isAddress } from "./inputs.js";

/** An input of a conversion, by who reads it: the core, or PDAL for it. */
export type Source =
  | { readonly reader: "core"; readonly file: string }
  | { readonly reader: "pdal"; readonly job: Job };

/**
 * Who reads which input: the core LAS and LAZ by their first bytes, whatever their names, and what is named so but is
 * none, so that it is refused; PDAL all else, and everything as one where there is a pipeline.
 *
 * @param pipeline file of a PDAL pipeline
 * @returns in the order of the inputs
 * @throws PdalError PDAL_PIPELINE
 */
export async function sourcesOf(inputs: readonly string[], pipeline: string | undefined): Promise<Source[]> {
  const { fileJob, pipelineJob } = await import("../pdal/pipeline.js");
  if (pipeline !== undefined) return [{ reader: "pdal", job: await pipelineJob(pipeline, inputs) }];
  const sources: Source[] = [];
  for (const input of inputs) {
    sources.push(
      (await isLas(input)) ? { reader: "core", file: input } : { reader: "pdal", job: fileJob(input) },
    );
  }
  return sources;
}

/** Whether the core reads this input, be it to refuse it. */
export async function isLas(input: string): Promise<boolean> {
  if (isAddress(input)) return false;
  if (/\.la[sz]$/i.test(input)) return true;
  try {
    // A pipe would be waited for.
    if (!(await stat(input)).isFile()) return true;
    const file = await open(input);
    try {
      const { buffer, bytesRead } = await file.read(Buffer.alloc(4), 0, 4, 0);
      return buffer.toString("latin1", 0, bytesRead) === "LASF";
    } finally {
      await file.close();
    }
  } catch {
    // The core says why it cannot be read.
    return true;
  }
}

/** Inputs that can be converted, in their order, and those that cannot. */
export interface Scans {
  readonly scanOf: ReadonlyMap<string, Scan>;
  readonly skipped: readonly Fault[];
}

/**
 * Headers and records of many files, as many at a time as the machine has cores. One of several that is empty or cannot
 * be read is skipped, a link to nothing too; a file that is not there is not, for its name may be misspelt.
 *
 * @param keepAll refuses every file that cannot be read; so does a single one
 * @throws CoreError INPUT_*
 */
export async function scanAll(
  files: readonly string[],
  keepAll: boolean,
  signal?: AbortSignal,
): Promise<Scans> {
  const answers: (Scan | CoreError)[] = new Array(files.length);
  let next = 0;
  const worker = async () => {
    for (let index = next++; index < files.length; index = next++) {
      try {
        answers[index] = await scanOrFault(files[index]!, keepAll, signal);
      } catch (error) {
        next = files.length;
        throw error;
      }
    }
  };
  await Promise.all(Array.from({ length: Math.min(files.length, availableParallelism()) }, worker));
  const scanOf = new Map<string, Scan>();
  const skipped: Fault[] = [];
  for (const [index, answer] of answers.entries()) {
    if (answer instanceof CoreError) {
      const { code, file, cause, fix } = answer;
      skipped.push({ code, file, cause, fix });
    } else scanOf.set(files[index]!, answer);
  }
  return { scanOf, skipped };
}

/** The scan of a file, or why it can be skipped. */
async function scanOrFault(file: string, keepAll: boolean, signal?: AbortSignal): Promise<Scan | CoreError> {
  try {
    const scan = await scanFile(file, signal);
    if (keepAll || scan.problem === null) return scan;
    return new CoreError(scan.problem);
  } catch (error) {
    const isThere = lstatSync(file, { throwIfNoEntry: false }) !== undefined;
    if (keepAll || !isThere || !(error instanceof CoreError) || !error.code.startsWith("INPUT_")) throw error;
    return error;
  }
}
