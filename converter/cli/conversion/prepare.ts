import type { Fault } from "@groma/georef";
import type { CoreEvent, PointBounds, Scan } from "../core/core.js";
import { OptionError } from "../given/option-error.js";
import { OutputError, requireOther, requirePlace } from "../given/output-place.js";
import type { Planned } from "../pdal/bring.js";
import type { Pdal } from "../pdal/find.js";
import type { Job } from "../pdal/pipeline.js";
import { commonGeoreference } from "../place/common-georeference.js";
import { chosenProj, type Proj } from "../place/engine.js";
import type { Georeferenced, Named } from "../place/georeference.js";
import { expectedWhereabouts, type Whereabouts } from "../place/whereabouts.js";
import { expandInputs, InputError } from "./inputs.js";
import type { ConvertOptions } from "./options.js";
import { scanAll, sourcesOf } from "./sources.js";

/** An input, and what is known of it before its points are converted. */
export type Prepared =
  | { readonly reader: "core"; readonly file: string; readonly scan: Scan }
  | { readonly reader: "pdal"; readonly planned: Planned };

/** Everything that can be known and refused before points are converted. */
export interface Preparation {
  /** At least one. */
  readonly inputs: readonly Prepared[];
  /** Inputs that are empty or cannot be read, which the conversion does without. */
  readonly skipped: readonly Fault[];
  readonly georeferenced: Georeferenced;
  /** By the bounds that the headers declare. */
  readonly whereabouts: Whereabouts;
  /** Where one of the inputs needs it. */
  readonly pdal?: Pdal;
  /** Where it is to place the points. */
  readonly proj?: Proj | undefined;
}

/**
 * Finds the inputs, reads their headers, lets PDAL pass over what only it can read, and settles the coordinate reference
 * system.
 *
 * @param args files, patterns, folders, addresses
 * @throws InputError, CoreError, PdalError, OutputError, CrsError, ProjError, OptionError
 */
export async function prepare(
  args: readonly string[],
  output: string,
  options: ConvertOptions,
  onEvent: (event: CoreEvent) => void,
  signal?: AbortSignal,
): Promise<Preparation> {
  const named = await expandInputs(args, output);
  requireOther(output, [...named, options.control, options.pipeline]);
  const found = await sourcesOf(named, options.pipeline);
  const files = found.flatMap((source) => (source.reader === "core" ? [source.file] : []));
  const jobs = found.flatMap((source) => (source.reader === "pdal" ? [source.job] : []));
  const searching = chosenProj(options);
  // Whether that matters shows when the CRS is known.
  searching.catch(() => undefined);
  // PDAL may take an hour; what the core would refuse after it is refused now.
  if (jobs.length > 0) requireTarget(output, options.overwrite ?? false, jobs);
  const { scanOf, skipped } = await scanAll(files, found.length === 1 || (options.strict ?? false), signal);
  for (const { file, cause } of skipped) onEvent({ event: "warning", text: `${file}: skipped: ${cause}` });
  const sources = found.filter((source) => source.reader === "pdal" || scanOf.has(source.file));
  if (sources.length === 0) throw noneLeft(skipped);
  const read =
    jobs.length > 0 ? await throughPdal(jobs, options, onEvent, signal) : await withoutPdal(options, files);

  const declared = sources.map((source): Named => {
    if (source.reader === "core") return scanOf.get(source.file)!;
    const { wkt } = read!.probes[jobs.indexOf(source.job)]!;
    return { file: source.job.name, ...(wkt && { wkt }) };
  });
  const georeferenced = await commonGeoreference(declared, options);
  // What is wrong with the choice of the engine is said before the points are read.
  const proj = georeferenced.local ? undefined : await searching;
  const geographic = georeferenced.crs.horizontalUnit.kind === "angular";
  const planned = read?.plan(read.probes, geographic, options.scale);
  const inputs = sources.map((source): Prepared => {
    if (source.reader === "core") return { ...source, scan: scanOf.get(source.file)! };
    return { reader: "pdal", planned: planned![jobs.indexOf(source.job)]! };
  });
  const bounds = boundsOf(inputs);
  const where = bounds ? expectedWhereabouts(georeferenced, bounds) : { centre: undefined, notes: [] };
  return { inputs, skipped, georeferenced, whereabouts: where, proj, ...(read && { pdal: read.pdal }) };
}

/** Bounds of all inputs with points; undefined where none has any that are numbers. */
function boundsOf(inputs: readonly Prepared[]): PointBounds | undefined {
  const boxes = inputs
    .map((input) => (input.reader === "core" ? input.scan : input.planned.probe))
    .filter(({ points, min, max }) => points > 0 && [...min, ...max].every(Number.isFinite));
  if (boxes.length === 0) return undefined;
  const min: [number, number, number] = [...boxes[0]!.min];
  const max: [number, number, number] = [...boxes[0]!.max];
  for (const box of boxes) {
    for (const axis of [0, 1, 2] as const) {
      min[axis] = Math.min(min[axis], box.min[axis]);
      max[axis] = Math.max(max[axis], box.max[axis]);
    }
  }
  return { min, max };
}

/** The error for inputs of which none can be read. */
function noneLeft(skipped: readonly Fault[]): InputError {
  const [first] = skipped;
  const more = skipped.length > 1 ? `; and ${skipped.length - 1} more` : "";
  return new InputError({
    code: "INPUT_NONE",
    file: first!.file,
    cause: `none of the ${skipped.length} inputs can be read: ${first!.code}: ${first!.cause}${more}`,
    fix: first!.fix,
  });
}

/** PDAL, what it finds in the jobs, and what settles how that is written; loaded only where it is needed. */
async function throughPdal(
  jobs: readonly Job[],
  { pdal: given }: ConvertOptions,
  onEvent: (event: CoreEvent) => void,
  signal?: AbortSignal,
) {
  const [{ findPdal }, { plan, probeAll }] = await Promise.all([
    import("../pdal/find.js"),
    import("../pdal/bring.js"),
  ]);
  const pdal = await findPdal(given, jobs[0]!.name);
  return { pdal, plan, probes: await probeAll(pdal, jobs, { onEvent, signal }) };
}

/**
 * What is given for PDAL is checked where it has nothing to read as well: who gives it expects that it has an effect.
 *
 * @throws PdalError PDAL_MISSING
 * @throws OptionError OPTION_SCALE
 */
async function withoutPdal({ pdal, scale }: ConvertOptions, files: readonly string[]): Promise<undefined> {
  if (scale !== undefined)
    throw new OptionError({
      code: "OPTION_SCALE",
      file: "--scale",
      cause: "LAS and LAZ keep the scale factors of their integers, and no input is read by PDAL",
      fix: "leave it out",
    });
  if (pdal === undefined) return;
  const { findPdal } = await import("../pdal/find.js");
  await findPdal(pdal, files[0]!);
}

function requireTarget(output: string, overwrite: boolean, jobs: readonly Job[]): void {
  const stages = jobs.flatMap((job) => job.stages);
  const read = stages.map((stage) => (typeof stage === "string" ? stage : stage.filename));
  requirePlace(
    output,
    overwrite,
    read.filter((file) => typeof file === "string"),
  );
  // As in the core, `output.rs`.
  if (!/\.laz$/i.test(output)) {
    throw new OutputError({
      ...{ code: "OUTPUT_NAME", file: output, cause: "a COPC file has a name that ends in .laz" },
      fix: "name it so, best with .copc.laz",
    });
  }
}
