import { writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import type { Fault } from "@groma/georef";
import { type Conversion, type CoreEvent, convertFiles, type RecordMaker } from "../core/core.js";
import { withScratch } from "../core/scratch.js";
import type { Planned } from "../pdal/bring.js";
import { type PdalReport, pdalReport } from "../pdal/report.js";
import { projString } from "../place/engine.js";
import type { Georeferenced } from "../place/georeference.js";
import { type GeoreferenceRecords, makeRecords } from "../place/records.js";
import type { Whereabouts } from "../place/whereabouts.js";
import { coreArguments } from "./arguments.js";
import type { ConvertOptions } from "./options.js";
import { type Preparation, prepare } from "./prepare.js";

/** What a conversion made, and where that stands on the earth. */
export interface Converted extends Conversion {
  readonly output: string;
  readonly georeferenced: Georeferenced;
  readonly whereabouts: Whereabouts;
  readonly records: GeoreferenceRecords;
  readonly pdal: readonly PdalReport[];
  /** Inputs that are empty or cannot be read, of which nothing is in the output. */
  readonly skipped: readonly Fault[];
}

/**
 * Scans into one COPC file with its georeference records. The output stands whole or not at all.
 *
 * @param args files, patterns, folders, addresses
 * @param signal stops it; nothing is left behind
 * @throws InputError, CoreError, PdalError, ScratchError, OutputError, CrsError, PlacementError, ProjError
 */
export async function convert(
  args: readonly string[],
  output: string,
  options: ConvertOptions,
  onEvent: (event: CoreEvent) => void,
  signal?: AbortSignal,
): Promise<Converted> {
  const preparation = await prepare(args, output, options, onEvent, signal);
  // A system that is not meant for the place is a mistake more often than not: said before the points are read.
  for (const { code, text } of preparation.whereabouts.notes) onEvent({ event: "warning", code, text });
  // What PDAL writes is as large as the points and belongs where the user has room; records are small.
  const parent = preparation.pdal ? (options.tempDir ?? dirname(output)) : tmpdir();
  return withScratch(parent, (scratch) =>
    convertPrepared(preparation, output, options, scratch, onEvent, signal),
  );
}

async function convertPrepared(
  preparation: Preparation,
  output: string,
  options: ConvertOptions,
  scratch: string,
  onEvent: (event: CoreEvent) => void,
  signal?: AbortSignal,
): Promise<Converted> {
  const { georeferenced, proj } = preparation;
  const files = await filesOf(preparation, scratch, onEvent, signal);
  const { file, scale } = firstOf(preparation);
  let records: GeoreferenceRecords | undefined;
  const recordsFor: RecordMaker = async (bounds, ended) => {
    const surroundings = { text: projString(options.crs), file, proj, signal: ended };
    records = await makeRecords(georeferenced, bounds, scale, options, surroundings);
    const record = join(scratch, "georeference.json");
    await writeFile(record, records.record);
    if (!records.transformation) return { record };
    const transformation = join(scratch, "transformation.bin");
    await writeFile(transformation, records.transformation);
    return { record, transformation };
  };
  const coreArgs = await coreArguments(files, output, georeferenced, options, scratch);
  const conversion = await convertFiles(coreArgs, onEvent, recordsFor, signal);
  if (!records) throw new Error("the converter core has not asked for the records");
  const pdal = plannedOf(preparation).map((planned) => pdalReport(preparation.pdal!, planned));
  const { skipped } = preparation;
  const { notes, centre: expected } = preparation.whereabouts;
  const whereabouts = { notes, centre: records.centre ?? expected };
  return { ...conversion, output, georeferenced, whereabouts, records, pdal, skipped };
}

/** What the core reads: the inputs themselves, and files of PDAL in place of the others. */
async function filesOf(
  preparation: Preparation,
  scratch: string,
  onEvent: (event: CoreEvent) => void,
  signal?: AbortSignal,
): Promise<string[]> {
  const planned = plannedOf(preparation);
  if (planned.length === 0)
    return preparation.inputs.flatMap((input) => ("file" in input ? [input.file] : []));
  const { write } = await import("../pdal/bring.js");
  const written = await write(preparation.pdal!, planned, scratch, { onEvent, signal });
  return preparation.inputs.map((input) =>
    input.reader === "core" ? input.file : written[planned.indexOf(input.planned)]!,
  );
}

function plannedOf({ inputs }: Preparation): Planned[] {
  return inputs.flatMap((input) => (input.reader === "pdal" ? [input.planned] : []));
}

/** Name and scale of the first input, as the user knows it. */
function firstOf({ inputs: [first] }: Preparation): { file: string; scale: readonly number[] } {
  if (first!.reader === "core") return { file: first!.file, scale: first!.scan.scale };
  return { file: first!.planned.probe.job.name, scale: first!.planned.form.scale };
}
