import { ProjError } from "./program/errors.js";
import type { Proj } from "./program/find.js";
import { run } from "./program/run.js";
import { pipelineWords, type StepText } from "./step-text.js";

/** Radians to degrees, so that the unit of what `cct` prints does not depend on what it takes the numbers for. */
const DEGREES: StepText = {
  name: "unitconvert",
  inverse: false,
  parameters: new Map([
    ["xy_in", "rad"],
    ["xy_out", "deg"],
  ]),
};

const RADIANS = Math.PI / 180;

/**
 * Runs points through a pipeline, all of them by one `cct`.
 *
 * @param points x, y, z of each, as the pipeline takes them
 * @returns three numbers a point, NaN where PROJ gives none
 * @throws ProjError PROJ_FAILED when PROJ does not take the pipeline, PROJ_OUTPUT when its answer cannot be read
 */
export async function runPipeline(
  proj: Proj,
  steps: readonly StepText[],
  points: Float64Array,
  signal?: AbortSignal,
): Promise<Float64Array> {
  const lines: string[] = [];
  for (let i = 0; i < points.length; i += 3) lines.push(`${points[i]} ${points[i + 1]} ${points[i + 2]}\n`);
  const outcome = await run(proj.cct, ["-d", "15", "-t", "0", ...pipelineWords(steps)], {
    environment: proj.environment,
    input: lines.join(""),
    signal,
  });
  if (outcome.status !== 0) {
    throw new ProjError({
      code: "PROJ_FAILED",
      file: proj.cct,
      cause: `it does not take the pipeline: ${outcome.stderr.trim().split("\n")[0].slice(0, 200)}`,
      fix: "give the folder of the grids that it names with --grids, or convert with --engine proj4js",
    });
  }
  return readPoints(outcome.stdout, lines.length, proj.cct);
}

/**
 * Runs x, y (source units) through the first steps of a pipeline, which end in radians.
 *
 * @returns longitude, latitude in radians of each point, NaN where there are none
 */
export async function runProjection(
  proj: Proj,
  steps: readonly StepText[],
  points: Float64Array,
  signal?: AbortSignal,
): Promise<Float64Array> {
  const spatial = new Float64Array((points.length / 2) * 3);
  for (let i = 0; i < points.length / 2; i++) spatial.set(points.subarray(2 * i, 2 * i + 2), 3 * i);
  const places = await runToRadians(proj, steps, spatial, signal);
  const out = new Float64Array(points.length);
  for (let i = 0; i < points.length / 2; i++) out.set(places.subarray(3 * i, 3 * i + 2), 2 * i);
  return out;
}

/** As {@link runPipeline} for steps that end in longitude, latitude (radians) and height. */
export async function runToRadians(
  proj: Proj,
  steps: readonly StepText[],
  points: Float64Array,
  signal?: AbortSignal,
): Promise<Float64Array> {
  const places = await runPipeline(proj, [...steps, DEGREES], points, signal);
  for (let i = 0; i < places.length; i += 3) {
    places[i] *= RADIANS;
    places[i + 1] *= RADIANS;
  }
  return places;
}

/**
 * Reads what `cct` prints: a line of four numbers for each point, and for a point that it cannot place a line with
 * asterisks or a comment `# Record n …`, whose rest may run on.
 */
export function readPoints(text: string, count: number, file: string): Float64Array {
  const out = new Float64Array(3 * count).fill(Number.NaN);
  let row = 0;
  for (const line of text.split("\n")) {
    if (/^#\s*Record \d+ /.test(line) || /^\s*\*/.test(line)) {
      row++;
      continue;
    }
    const words = line.trim().split(/\s+/);
    if (words.length < 3 || !words.slice(0, 3).every((word) => /^[-+]?(\d|inf|nan)/i.test(word))) continue;
    const values = words.slice(0, 3).map(Number);
    if (row < count && values.every(Number.isFinite)) out.set(values, 3 * row);
    row++;
  }
  if (row === count) return out;
  throw new ProjError({
    code: "PROJ_OUTPUT",
    file,
    cause: `it answered ${row} of ${count} points`,
    fix: "run it by hand to see what is wrong with the PROJ installation, or convert with --engine proj4js",
  });
}
