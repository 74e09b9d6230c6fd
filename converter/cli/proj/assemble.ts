import {
  type EllipsoidAxes,
  fitPatchwork,
  type GridWindow,
  type Patchwork,
  type Step,
  type Transformation,
} from "@groma/georef";
import type { Candidate } from "./candidate.js";
import { runProjection } from "./cct.js";
import { ellipsoidAxes } from "./ellipsoid.js";
import type { Proj } from "./find.js";
import type { EllipsoidText, PlannedStep } from "./plan.js";

export interface AssembleOptions {
  readonly domain: Parameters<typeof fitPatchwork>[1];
  /** Metres. */
  readonly tolerance: number;
  /** For error messages. */
  readonly file: string;
  readonly signal?: AbortSignal | undefined;
}

/** Fits the projection and puts the steps together. */
export async function assemble(
  proj: Proj,
  { plan, zScale }: Candidate,
  windows: readonly GridWindow[],
  { domain, tolerance, file, signal }: AssembleOptions,
): Promise<{ transformation: Transformation; patchwork: Patchwork }> {
  const projection = plan.pipeline.slice(0, plan.projection);
  const sample = (points: Float64Array) => runProjection(proj, projection, points, signal);
  const patchwork = await fitPatchwork(sample, domain, tolerance, undefined, file);

  const steps: Step[] = [{ kind: "projection", patchwork }];
  if (zScale !== 1) steps.push({ kind: "height", metresPerUnit: zScale });
  const axes = await axesOf(proj, plan.steps, signal);
  const unused = [...windows];
  for (const step of plan.steps) {
    if (step.kind === "height") steps.push(step);
    else if (step.kind === "geocentric") {
      steps.push({ kind: "geocentric", ellipsoid: axes.get(step.ellipsoid)! });
    } else if (step.kind === "datumShift") {
      const { map, keepHeight } = step;
      const [from, to] = [axes.get(step.from)!, axes.get(step.to)!];
      steps.push({ kind: "datumShift", from, to, ...map, keepHeight });
    } else {
      const window = unused.shift();
      if (!window) throw new RangeError("fewer windows than steps that use a grid");
      if (step.kind === "verticalShift") steps.push({ kind: step.kind, multiplier: step.multiplier, window });
      else steps.push({ kind: step.kind, direction: step.direction, window });
    }
  }
  return { transformation: { steps }, patchwork };
}

/** The axes of every ellipsoid that the steps name; equal ones are asked for once. */
async function axesOf(
  proj: Proj,
  steps: readonly PlannedStep[],
  signal?: AbortSignal,
): Promise<Map<EllipsoidText, EllipsoidAxes>> {
  const asked = new Map<string, EllipsoidAxes>();
  const axes = new Map<EllipsoidText, EllipsoidAxes>();
  const texts = steps.flatMap((step) => {
    if (step.kind === "geocentric") return [step.ellipsoid];
    return step.kind === "datumShift" ? [step.from, step.to] : [];
  });
  for (const text of texts) {
    const key = [...text].map((pair) => pair.join("=")).join(" ");
    const known = asked.get(key) ?? (await ellipsoidAxes(proj, text, signal));
    asked.set(key, known);
    axes.set(text, known);
  }
  return axes;
}
