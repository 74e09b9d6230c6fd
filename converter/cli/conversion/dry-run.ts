import { tmpdir } from "node:os";
import { dirname, resolve } from "node:path";
import type { Fault } from "@groma/georef";
import { type CoreEvent, type Plan, planFiles } from "../core/core.js";
import { freeBytes, withScratch } from "../core/scratch.js";
import { type PdalReport, pdalInWords, pdalReport } from "../pdal/report.js";
import { crsInWords, heightInWords } from "../place/describe.js";
import type { Georeferenced } from "../place/georeference.js";
import { centreRow, type Whereabouts } from "../place/whereabouts.js";
import { count, counted, labelled, size, skippedRow } from "../terminal/output.js";
import { coreArguments } from "./arguments.js";
import type { ConvertOptions } from "./options.js";
import { prepare } from "./prepare.js";

/** What a conversion would do. */
export interface DryRun {
  readonly output: string;
  /** Number of files and jobs of PDAL. */
  readonly inputs: number;
  /** Inputs that are empty or cannot be read, which are not counted. */
  readonly skipped: readonly Fault[];
  readonly points: number;
  readonly georeferenced: Georeferenced;
  readonly whereabouts: Whereabouts;
  /** What the core would do; undefined where inputs have to go through PDAL first. */
  readonly core: Plan | undefined;
  readonly pdal: readonly PdalReport[];
  /** Folder of PDAL's temporary files and the bytes free there; undefined without PDAL. */
  readonly pdalTemp: { readonly folder: string; readonly bytes: number; readonly free: number } | undefined;
}

/**
 * Does everything of a conversion that comes before its points; PDAL passes over the points that only it can read.
 *
 * @throws as a conversion does until then
 */
export async function dryRun(
  args: readonly string[],
  output: string,
  options: ConvertOptions,
  onEvent: (event: CoreEvent) => void,
  signal?: AbortSignal,
): Promise<DryRun> {
  const preparation = await prepare(args, output, options, onEvent, signal);
  const { inputs, georeferenced, whereabouts } = preparation;
  const files = inputs.flatMap((input) => (input.reader === "core" ? [input.file] : []));
  const announced = inputs.reduce(
    (sum, input) => sum + (input.reader === "core" ? input.scan.points : input.planned.probe.points),
    0,
  );
  const pdal = inputs.flatMap((input) =>
    input.reader === "pdal" ? [pdalReport(preparation.pdal!, input.planned)] : [],
  );
  const folder = resolve(options.tempDir ?? dirname(output));
  const pdalTemp =
    pdal.length > 0
      ? { folder, bytes: pdal.reduce((sum, one) => sum + one.tempBytes, 0), free: await freeBytes(folder) }
      : undefined;
  const core = pdalTemp
    ? undefined
    : await withScratch(tmpdir(), async (scratch) =>
        planFiles(await coreArguments(files, output, georeferenced, options, scratch), onEvent, signal),
      );
  const { skipped } = preparation;
  return {
    ...{ output, inputs: inputs.length, skipped, georeferenced, whereabouts, core, pdal, pdalTemp },
    points: core?.points ?? announced,
  };
}

/** The plan as one JSON object. */
export function planForMachines({ georeferenced, whereabouts, core, ...rest }: DryRun) {
  const { name, code, height } = georeferenced.crs;
  const known = core ?? {
    recordLength: null,
    levels: null,
    memory: null,
    tempBytes: null,
    outputBytes: null,
  };
  return {
    event: "plan",
    ...known,
    ...rest,
    crs: { name, code, height },
    crsFrom: georeferenced.basis,
    crsNotes: georeferenced.notes,
  };
}

/** The plan, a line for each thing. */
export function planInWords(plan: DryRun): string[] {
  const { output, inputs, skipped, points, georeferenced, whereabouts, core, pdal, pdalTemp } = plan;
  const { crs, basis, notes, heightGiven } = georeferenced;
  const rows: [string, string][] = [
    ["inputs", `${count(inputs)}, ${count(points)} points`],
    ...skipped.map(skippedRow),
    ...pdal.flatMap(pdalInWords).map((text): [string, string] => ["pdal", text]),
    ["place", `${crsInWords(crs)} (${basis}${heightGiven ? "; height given" : ""})`],
    ["height", heightInWords(crs)],
    ...centreRow(whereabouts),
    ...[...notes, ...whereabouts.notes].map(({ text }): [string, string] => ["note", text]),
  ];
  if (core) {
    rows.push(
      [
        "octree",
        `about ${counted(core.levels, "level")}, ${core.recordLength} bytes per point, sampling ${core.sampling}`,
      ],
      ["memory", `at most ${size(core.memory)}`],
      ["temp", tempInWords(core)],
      ["output", `${output}, about ${size(core.outputBytes)}`],
    );
  } else if (pdalTemp) {
    rows.push(
      ["temp", `${size(pdalTemp.bytes)} for PDAL in ${pdalTemp.folder}, ${size(pdalTemp.free)} free`],
      ["output", `${output}; the octree is planned once PDAL has read the inputs`],
    );
  }
  return labelled(rows);
}

function tempInWords({ tempBytes, tempDir, tempFree }: Plan): string {
  if (tempBytes === 0) return "none, the points fit into memory";
  return `at most ${size(tempBytes)} in ${resolve(tempDir)}, ${size(tempFree)} free`;
}
