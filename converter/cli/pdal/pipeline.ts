import { readFile } from "node:fs/promises";
import { PdalError } from "./errors.js";

/** A stage of a PDAL pipeline: a file, or an object with its options. */
export type Stage = string | { readonly type?: string; readonly [option: string]: unknown };

/** A pipeline is run as one data set; what it reads is named in it, or given besides. */
export interface Job {
  /** What errors and summaries call it. */
  readonly name: string;
  readonly stages: readonly Stage[];
}

/** The job that reads one file as it is. */
export function fileJob(file: string): Job {
  return { name: file, stages: [{ filename: file }] };
}

/**
 * The job of a user's pipeline (https://pdal.io/pipeline.html: an array, or an object with the array as `pipeline`).
 *
 * @param inputs files that are read in front of it
 * @throws PdalError PDAL_PIPELINE when it cannot be read, is none, or writes by itself
 */
export async function pipelineJob(file: string, inputs: readonly string[]): Promise<Job> {
  const refuse = (cause: string, fix = "give an array of stages that ends before the writer") =>
    new PdalError({ code: "PDAL_PIPELINE", file, cause, fix });
  let parsed: unknown;
  try {
    parsed = JSON.parse(await readFile(file, "utf8"));
  } catch (error) {
    throw refuse(error instanceof SyntaxError ? `not valid JSON (${error.message})` : "it cannot be read");
  }
  const stages = isObject(parsed) ? parsed.pipeline : parsed;
  if (!Array.isArray(stages) || !stages.every(isStage)) throw refuse("not a PDAL pipeline");
  const writer = stages.map(typeOf).find((type) => type.startsWith("writers."));
  if (writer)
    throw refuse(`it contains the writer ${writer}`, "remove the writer: Groma writes the COPC file");
  const whole = [...inputs.map((filename) => ({ filename })), ...stages];
  if (whole.length === 0 || typeOf(whole[0]).startsWith("filters.")) {
    throw refuse("it has no reader", "name an input before the output, or add a reader to the pipeline");
  }
  return { name: file, stages: whole };
}

/** `readers.las`; empty where PDAL has to find out by itself. */
export function typeOf(stage: Stage | undefined): string {
  return typeof stage === "object" && typeof stage.type === "string" ? stage.type : "";
}

function isStage(value: unknown): value is Stage {
  return typeof value === "string" || isObject(value);
}

function isObject(value: unknown): value is { readonly [key: string]: unknown } {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
