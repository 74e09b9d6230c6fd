import { writeFile } from "node:fs/promises";
import { join } from "node:path";
import type { Georeferenced } from "../place/georeference.js";
import { outputWkt } from "../place/output-wkt.js";
import type { ConvertOptions } from "./options.js";

/** Inputs that go onto the command line; more of them might not fit. */
const FEW = 64;

/**
 * The arguments of `groma-core convert`.
 *
 * @param georeferenced what the output declares
 * @param scratch folder for the WKT and the list of the inputs
 */
export async function coreArguments(
  inputs: readonly string[],
  output: string,
  georeferenced: Georeferenced,
  options: ConvertOptions,
  scratch: string,
): Promise<string[]> {
  const args: string[] = [];
  const add = (name: string, value: string | number | undefined) => {
    if (value !== undefined) args.push(name, String(value));
  };
  const wkt = join(scratch, "crs.wkt");
  await writeFile(wkt, outputWkt(georeferenced));
  add("--wkt", wkt);
  add("--sampling", options.sampling);
  add("--threads", options.threads);
  add("--memory", options.memory);
  add("--temp-dir", options.tempDir);
  if (options.averageColors) args.push("--average-colors");
  if (options.strict) args.push("--strict");
  if (options.overwrite) args.push("--overwrite");
  const onLine = inputs.length <= FEW || inputs.some((input) => input.includes("\n"));
  if (onLine) return [...args, "--", ...inputs, output];
  const list = join(scratch, "inputs.txt");
  await writeFile(list, inputs.map((input) => `${input}\n`).join(""));
  return [...args, "--list", list, "--", output];
}
