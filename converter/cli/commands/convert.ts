import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { statedAccuracy } from "@groma/georef";
import { type Conversion, convertFiles, type RecordMaker, type Scan, scanFile } from "../core.js";
import { placeInWords, remarks } from "../describe.js";
import { commonGeoreference, type Georeferenced, type Given, wktOf } from "../georeference.js";
import { count, length, size } from "../output.js";
import { chosenProj, type EngineChoice } from "../place/engine.js";
import { type GeoreferenceRecords, makeRecords } from "../place/records.js";
import { createProgress, defaultProgress, type ProgressKind } from "../progress.js";

export interface ConvertOptions extends Given, EngineChoice {
  readonly sampling?: string;
  readonly memory?: string;
  readonly tempDir?: string;
  readonly progress?: ProgressKind;
  readonly overwrite?: boolean;
}

/** What a conversion made, and where that stands on the earth. */
export interface Converted extends Conversion {
  readonly output: string;
  readonly georeferenced: Georeferenced;
  readonly records: GeoreferenceRecords;
}

/**
 * LAS and LAZ files into one COPC file with its georeference records. The output stands whole or not at all.
 *
 * @throws CrsError, PlacementError, ProjError, CoreError
 */
export async function convert(
  inputs: readonly string[],
  output: string,
  options: ConvertOptions,
): Promise<Converted> {
  const scans: Scan[] = [];
  for (const input of inputs) scans.push(await scanFile(input));
  const georeferenced = await commonGeoreference(scans, options);
  // What is wrong with the choice of the engine is said before the points are read.
  if (!georeferenced.local) await chosenProj(options);

  const scratch = await mkdtemp(join(tmpdir(), "groma-"));
  const progress = createProgress(options.progress ?? defaultProgress());
  let records: GeoreferenceRecords | undefined;
  const recordsFor: RecordMaker = async (bounds, signal) => {
    const surroundings = { text: projString(options.crs), file: inputs[0]!, signal };
    records = await makeRecords(georeferenced, bounds, scans[0]!.scale, options, surroundings);
    const record = join(scratch, "georeference.json");
    await writeFile(record, records.record);
    if (!records.transformation) return { record };
    const transformation = join(scratch, "transformation.bin");
    await writeFile(transformation, records.transformation);
    return { record, transformation };
  };
  try {
    const args = [...inputs, output];
    const replaced = options.crs !== undefined || georeferenced.local !== undefined;
    const wkt = scans.some((scan) => scan.wkt) && !replaced ? undefined : wktOf(georeferenced);
    if (wkt !== undefined) {
      await writeFile(join(scratch, "crs.wkt"), wkt);
      args.push("--wkt", join(scratch, "crs.wkt"));
    }
    if (options.sampling !== undefined) args.push("--sampling", options.sampling);
    if (options.memory !== undefined) args.push("--memory", options.memory);
    if (options.tempDir !== undefined) args.push("--temp-dir", options.tempDir);
    if (options.overwrite) args.push("--overwrite");
    const conversion = await convertFiles(args, (event) => progress.show(event), recordsFor);
    if (!records) throw new Error("the converter core has not asked for the records");
    return { ...conversion, output, georeferenced, records };
  } finally {
    progress.stop();
    await rm(scratch, { recursive: true, force: true });
  }
}

/** A PROJ string says more to PROJ than what was read from it: its grids above all. */
function projString(crs: string | undefined): string | undefined {
  return crs?.trim().startsWith("+") ? crs : undefined;
}

/** The `convert` command: a summary for people or JSON for machines. */
export async function runConvert(files: readonly string[], options: ConvertOptions): Promise<void> {
  const inputs = files.slice(0, -1);
  const result = await convert(inputs, files.at(-1)!, options);
  if (options.progress === "json") {
    process.stdout.write(`${JSON.stringify(machineForm(result))}\n`);
    return;
  }
  const { points, nodes, bytes, seconds } = result;
  const name = basename(result.output);
  process.stdout.write(
    `${name}  ${count(points)} points in ${count(nodes)} nodes  ${size(bytes)}  ${seconds.toFixed(1)} s\n`,
  );
  process.stdout.write(placeSummary(result));
}

function machineForm({ georeferenced, records, ...summary }: Converted) {
  const { crs, engine, operation, accuracy } = records.georeference;
  return {
    event: "done",
    ...summary,
    crs: { name: crs.name, code: crs.code, height: crs.height },
    engine,
    operation: operation ?? null,
    residuals: georeferenced.local?.fitted?.residuals ?? null,
    accuracy: statedAccuracy(accuracy),
    recordBytes: records.record.length,
    transformationBytes: records.transformation?.length ?? 0,
  };
}

/** Where the points are, how that was found, and what has to be known of it, a line each. */
export function placeSummary({ georeferenced, records }: Converted): string {
  const { crs, engine, operation, accuracy } = records.georeference;
  const lines = [
    `place    ${placeInWords({ crs, engine, operation, accuracy, fitBound: records.fitBound })}`,
  ];
  const said = remarks(operation);
  if (said.length > 0) lines.push(`note     ${said.join("; ")}`);
  for (const [index, residual] of (georeferenced.local?.fitted?.residuals ?? []).entries()) {
    lines.push(`control  point ${index + 1}: ${length(residual)} off`);
  }
  return lines.map((line) => `${line}\n`).join("");
}
