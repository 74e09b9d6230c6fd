import type { OperationReport } from "@groma/georef";
import { type Scan, scanFile } from "../core/core.js";
import { isAddress, readHead } from "../files/points.js";
import { declarationOf } from "../place/declaration.js";
import { chosenProj, type EngineChoice, projString } from "../place/engine.js";
import { type Given, georeference } from "../place/georeference.js";
import { makeRecords } from "../place/records.js";
import { type Remedy, remedies } from "../place/remedies.js";
import { interruptible } from "../terminal/interruption.js";
import { labelled, length, print, printJson } from "../terminal/output.js";

export interface GridsOptions extends Given {
  readonly json?: boolean;
}

/** What grids are to a data set. */
interface Grids {
  readonly operation: OperationReport | undefined;
  /** Better ways, as PROJ prefers them, and the grids that they lack. */
  readonly better: readonly Remedy[];
  /** Where PROJ looks for grids, the first one first. */
  readonly folders: readonly string[];
}

/**
 * The `grids` command: which grids PROJ has for a file, which better ones it lacks, and how they are had. Only the header
 * is read, of an address by Range requests.
 *
 * @throws CoreError, InputFileError, SourceError, CrsError, PlacementError, ProjError
 */
export async function runGrids(input: string, { json = false, ...given }: GridsOptions): Promise<void> {
  const grids = await interruptible((signal) => gridsOf(input, given, signal));
  if (json) printJson(grids);
  else print(inWords(grids));
}

async function gridsOf(input: string, given: Given, signal: AbortSignal): Promise<Grids> {
  const choice: EngineChoice = { ...given, engine: "proj" };
  const proj = await chosenProj(choice);
  const folders = proj?.directories ?? [];
  const scan = await headOf(input, signal);
  const georeferenced = await georeference(scan, { ...given, ...choice });
  if (georeferenced.local) return { operation: undefined, better: [], folders };
  const surroundings = { text: projString(given.crs), file: scan.file, signal };
  const { georeference: record } = await makeRecords(georeferenced, scan, scan.scale, choice, surroundings);
  return { operation: record.operation, better: remedies(record.operation), folders };
}

async function headOf(
  input: string,
  signal: AbortSignal,
): Promise<Pick<Scan, "file" | "min" | "max" | "scale">> {
  if (!isAddress(input)) return scanFile(input, signal);
  const source = await readHead(input, signal);
  return { ...declarationOf(source), ...source.boundingBox };
}

type Row = [label: string, text: string];

function inWords({ operation, better, folders }: Grids): string[] {
  if (!operation)
    return labelled([["grids", "none needed: the scan has no coordinate reference system of its own"]]);
  const worth = (accuracy: number | null) =>
    accuracy === null ? "accuracy not published" : length(accuracy);
  const missing = new Map(better.flatMap(({ grids }) => grids.map((grid) => [grid.name, grid] as const)));
  return labelled([
    ["operation", `${operation.name} (${worth(operation.accuracy)})`],
    ["grids", operation.grids.length === 0 ? "none" : operation.grids.join(", ")],
    ...(better.length === 0 ? [["better", "nothing that PROJ knows"] as Row] : []),
    ...better.flatMap(({ operation, accuracy, grids }): Row[] => [
      ["better", `${operation} (${worth(accuracy)})`],
      ["lacks", grids.map(({ name }) => name).join(", ")],
    ]),
    ...[...missing.values()].flatMap(({ get, url }): Row[] => (get ? [["get", `${get}    or ${url}`]] : [])),
    ...(better.length > 0 ? folders.map((folder): Row => ["folder", folder]) : []),
  ]);
}
