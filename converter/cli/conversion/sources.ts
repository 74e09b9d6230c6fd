import { open } from "node:fs/promises";
import { availableParallelism } from "node:os";
import { type Scan, scanFile } from "../core.js";
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

/**
 * Headers and records of many files, as many at a time as the machine has cores.
 *
 * @throws CoreError INPUT_*
 */
export async function scanAll(files: readonly string[], signal?: AbortSignal): Promise<Scan[]> {
  const scans: Scan[] = new Array(files.length);
  let next = 0;
  const worker = async () => {
    try {
      for (let index = next++; index < files.length; index = next++) {
        scans[index] = await scanFile(files[index]!, signal);
      }
    } catch (error) {
      next = files.length;
      throw error;
    }
  };
  await Promise.all(Array.from({ length: Math.min(files.length, availableParallelism()) }, worker));
  return scans;
}
