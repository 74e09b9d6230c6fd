import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { type Conversion, convertFiles, scanFile } from "../core.js";
import { commonGeoreference, type Georeferenced, type Given, recordOf, wktOf } from "../georeference.js";
import { count, size } from "../output.js";
import { createProgress, defaultProgress, type ProgressKind } from "../progress.js";

export interface ConvertOptions extends Given {
  readonly sampling?: string;
  readonly memory?: string;
  readonly tempDir?: string;
  readonly progress?: ProgressKind;
  readonly overwrite?: boolean;
}

/** What a conversion made, and where that stands on the earth. */
export interface Converted extends Conversion {
  readonly output: string;
  readonly georeference: Georeferenced;
}

/**
 * LAS and LAZ files into one COPC file with its georeference record. The output stands whole or not at all.
 *
 * @throws CrsError, CoreError
 */
export async function convert(
  inputs: readonly string[],
  output: string,
  options: ConvertOptions,
): Promise<Converted> {
  const scans = [];
  for (const input of inputs) scans.push(await scanFile(input));
  const georeference = commonGeoreference(scans, options);
  const { crs } = georeference;

  const scratch = await mkdtemp(join(tmpdir(), "groma-"));
  const progress = createProgress(options.progress ?? defaultProgress());
  try {
    const record = join(scratch, "georeference.json");
    await writeFile(record, recordOf(crs, scans[0]!.scale));
    const args = [...inputs, output, "--record", record];
    const wkt = scans.some((scan) => scan.wkt) && options.crs === undefined ? undefined : wktOf(crs);
    if (wkt !== undefined) {
      await writeFile(join(scratch, "crs.wkt"), wkt);
      args.push("--wkt", join(scratch, "crs.wkt"));
    }
    if (options.sampling !== undefined) args.push("--sampling", options.sampling);
    if (options.memory !== undefined) args.push("--memory", options.memory);
    if (options.tempDir !== undefined) args.push("--temp-dir", options.tempDir);
    if (options.overwrite) args.push("--overwrite");
    const conversion = await convertFiles(args, (event) => progress.show(event));
    return { ...conversion, output, georeference };
  } finally {
    progress.stop();
    await rm(scratch, { recursive: true, force: true });
  }
}

/** The `convert` command: one summary, a line for people or JSON for machines. */
export async function runConvert(files: readonly string[], options: ConvertOptions): Promise<void> {
  const inputs = files.slice(0, -1);
  const result = await convert(inputs, files.at(-1)!, options);
  if (options.progress === "json") {
    const { georeference, ...summary } = result;
    const crs = { name: georeference.crs.name, code: georeference.crs.code, height: georeference.crs.height };
    process.stdout.write(`${JSON.stringify({ event: "done", ...summary, crs })}\n`);
    return;
  }
  const { points, nodes, bytes, seconds, georeference } = result;
  const name = basename(result.output);
  process.stdout.write(
    `${name}  ${count(points)} points in ${count(nodes)} nodes  ${size(bytes)}  ${seconds.toFixed(1)} s  ${georeference.crs.name}\n`,
  );
}
