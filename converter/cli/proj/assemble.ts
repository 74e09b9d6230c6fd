import {
  type ChoiceStep,
  type Domain,
  type EllipsoidAxes,
  fitPatchwork,
  type GeocentricStep,
  type Patchwork,
  type Rectangle,
  type ShiftStep,
  type Transformation,
} from "@groma/georef";
import type { Candidate, Choice } from "./candidate.js";
import { runProjection } from "./cct.js";
import { constantShift, constantWindow } from "./constant-window.js";
import { ellipsoidAxes } from "./ellipsoid.js";
import type { EllipsoidText, PlannedStep } from "./plan.js";
import type { Proj } from "./program/find.js";
import { pipelineWords } from "./step-text.js";

const ARC_SECOND = Math.PI / 648_000;

/** What a transformation is assembled for. */
export interface AssembleOptions {
  readonly domain: Domain;
  /** Metres. */
  readonly tolerance: number;
  /** For error messages. */
  readonly file: string;
  readonly signal?: AbortSignal | undefined;
}

/**
 * Fits the projection and puts the steps together: those of the one way, or a choice between several.
 *
 * @param ways all with one projection, and one ellipsoid in the end ({@link isSameGround})
 */
export async function assemble(
  proj: Proj,
  ways: readonly [AssembledWay, ...AssembledWay[]],
  { domain, tolerance, file, signal }: AssembleOptions,
): Promise<{ transformation: Transformation; patchwork: Patchwork }> {
  const { plan } = ways[0].candidate;
  const projection = plan.pipeline.slice(0, plan.projection);
  const sample = (points: Float64Array) => runProjection(proj, projection, points, signal);
  const patchwork = await fitPatchwork(sample, domain, tolerance, undefined, file);
  const chains: Awaited<ReturnType<typeof stepsOf>>[] = [];
  for (const way of ways) chains.push(await stepsOf(proj, way, signal));
  const sampled = Math.max(...chains.map(({ bound }) => bound));
  const [{ steps, last }] = chains as [(typeof chains)[0]];
  const choice: ChoiceStep = {
    kind: "choice",
    ways: ways.flatMap(({ areas }, i) => areas.map((area) => ({ area, steps: chains[i]!.steps }))),
  };
  const middle = ways.length > 1 ? [choice] : steps;
  const whole = { ...patchwork, bound: patchwork.bound + sampled };
  return {
    transformation: { steps: [{ kind: "projection", patchwork: whole }, ...middle, last] },
    patchwork: whole,
  };
}

/** An operation that is followed in its areas (source units). */
export interface AssembledWay extends Choice {
  readonly areas: readonly Rectangle[];
}

/** Whether operations differ only in what lies between the projection and the last ellipsoid. */
export function isSameGround(a: Candidate, b: Candidate): boolean {
  const ends = ({ plan, zScale }: Candidate) => {
    const last = plan.steps[plan.steps.length - 1];
    const ellipsoid = last?.kind === "geocentric" ? [...last.ellipsoid] : [];
    return JSON.stringify([zScale, ellipsoid, pipelineWords(plan.pipeline.slice(0, plan.projection))]);
  };
  return ends(a) === ends(b);
}

/** What lies between the projection and the last step, how far it may be off (metres), and the last step. */
async function stepsOf(
  proj: Proj,
  { candidate: { plan, zScale }, windows, sampled }: Choice,
  signal?: AbortSignal,
): Promise<{ steps: ShiftStep[]; bound: number; last: GeocentricStep }> {
  const steps: ShiftStep[] = [];
  let bound = 0;
  if (zScale !== 1) steps.push({ kind: "height", metresPerUnit: zScale });
  const axes = await axesOf(proj, plan.steps, signal);
  const unused = [...windows];
  const unsampled = [...sampled];
  for (const step of plan.steps) {
    if (step.kind === "height") steps.push(step);
    else if (step.kind === "geocentric") {
      return { steps, bound, last: { kind: "geocentric", ellipsoid: axes.get(step.ellipsoid)! } };
    } else if (step.kind === "datumShift") {
      const { map, keepHeight } = step;
      const [from, to] = [axes.get(step.from)!, axes.get(step.to)!];
      steps.push({ kind: "datumShift", from, to, ...map, keepHeight });
    } else if (step.kind === "horizontalOffset") {
      for (const window of constantShift(step.longitude * ARC_SECOND, step.latitude * ARC_SECOND)) {
        steps.push({ kind: "horizontalShift", direction: "forward", window });
      }
    } else if (step.kind === "sampled") {
      const taken = unsampled.shift();
      if (!taken) throw new RangeError("fewer rasters than steps that are sampled");
      steps.push(...taken.steps);
      bound += taken.bound;
    } else if (step.kind === "verticalOffset") {
      steps.push({ kind: "verticalShift", multiplier: step.metres, window: constantWindow([1]) });
    } else {
      const window = unused.shift();
      if (!window) throw new RangeError("fewer windows than steps that use a grid");
      if (step.kind === "verticalShift") steps.push({ kind: step.kind, multiplier: step.multiplier, window });
      else steps.push({ kind: step.kind, direction: step.direction, window });
    }
  }
  throw new RangeError("a pipeline that does not end in ECEF");
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
