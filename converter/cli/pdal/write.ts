import { type Scan, scanFile } from "../core/core.js";
import { PdalError } from "./errors.js";
import type { Pdal } from "./find.js";
import { asideName, type Form } from "./form.js";
import type { Stage } from "./pipeline.js";
import type { Probe } from "./probe.js";
import { complaint, failed, runPdal } from "./run.js";

/** Header fields and records of LAS inputs that say something of the points. */
const FORWARDED = "filesource_id,global_encoding,project_id,system_id,vlr";

/** Bounds are told with ten digits. */
const TOLD = 1e-9;

/**
 * Runs a job into a LAS 1.4 file and holds what arrived against what was announced.
 *
 * @returns the file's scan
 * @throws PdalError PDAL_FAILED, PDAL_MISMATCH
 */
export async function writeLas(
  pdal: Pdal,
  announced: Probe,
  form: Form,
  file: string,
  signal?: AbortSignal,
): Promise<Scan> {
  const { job } = announced;
  const stages = [...job.stages, ...aside(form), writer(form, file)];
  const mode = announced.streamed ? ["--stream"] : [];
  const input = JSON.stringify({ pipeline: stages });
  const outcome = await runPdal(pdal.program, ["pipeline", "--stdin", ...mode], input, signal);
  if (outcome.status !== 0) throw failed(job.name, complaint(outcome));
  const scan = await scanFile(file, signal);
  const wrong = difference(announced, form, scan);
  if (wrong === undefined) return scan;
  throw new PdalError({
    ...{ code: "PDAL_MISMATCH", file: job.name, cause: wrong },
    fix: "check that the input is not being written, and try a newer PDAL",
  });
}

/** Copies what LAS's fields cannot hold to attributes of its own, before it would make the writer fail. */
function aside({ keptAside }: Form): Stage[] {
  if (keptAside.length === 0) return [];
  return [
    { type: "filters.ferry", dimensions: keptAside.map((name) => `${name}=>${asideName(name)}`).join(",") },
    ...keptAside.map((name) => ({ type: "filters.assign", assignment: `${name}[:]=0` })),
  ];
}

function writer({ scale, offset, pointFormat }: Form, filename: string): Stage {
  const axes = ["x", "y", "z"].flatMap((axis, index) => [
    [`scale_${axis}`, scale[index]],
    [`offset_${axis}`, offset[index]],
  ]);
  return {
    ...{ type: "writers.las", filename, forward: FORWARDED, extra_dims: "all" },
    ...{ major_version: 1, minor_version: 4, dataformat_id: pointFormat },
    ...Object.fromEntries(axes),
  };
}

/** What is another than announced, in words. */
function difference(announced: Probe, { scale }: Form, scan: Scan): string | undefined {
  if (scan.points !== announced.points) {
    return `PDAL announced ${announced.points} points but wrote ${scan.points}`;
  }
  for (const [axis, name] of ["x", "y", "z"].entries()) {
    const [low, high] = [announced.min[axis]!, announced.max[axis]!];
    const off = Math.max(Math.abs(scan.min[axis]! - low), Math.abs(scan.max[axis]! - high));
    if (off <= scale[axis]! + TOLD * Math.max(Math.abs(low), Math.abs(high))) continue;
    return `PDAL announced ${name} from ${low} to ${high}, it is from ${scan.min[axis]} to ${scan.max[axis]}`;
  }
  const [before, after] = [systemOf(announced.wkt), systemOf(scan.wkt ?? "")];
  if (before === after) return undefined;
  return `PDAL announced the coordinate reference system ${before || "none"}, ${after || "none"} has arrived`;
}

/** Name of a system, and whether it has heights: the same in every version of WKT. */
function systemOf(wkt: string): string {
  const name = /"([^"]*)"/.exec(wkt)?.[1] ?? "";
  return name && /\bVERT(_?CS|CRS)\b/i.test(wkt) ? `${name} with heights` : name;
}
