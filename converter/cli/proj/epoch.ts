import type { StepText } from "./step-text.js";

/** A pipeline whose steps no longer depend on the time of a point. */
export interface Dated {
  readonly steps: readonly StepText[];
  /** A step changes with time, and no epoch is known: it is taken as it was at its own. */
  readonly undated: boolean;
}

/** Rates of `helmert`, each by what it adds to in a year. */
const RATES: readonly (readonly [rate: string, of: string])[] = [
  ...["x", "y", "z", "rx", "ry", "rz", "s"].map((of) => [`d${of}`, of] as const),
];

/**
 * Works out the steps that change with time for the epoch that PROJ sets (`+proj=set +v_4`, from a CRS such as
 * `EPSG:9309@2023.25`): parameters of `helmert` grow by their rates since `t_epoch`, `deformation` gets its span in years.
 * Without an epoch PROJ leaves the rates out (helmert.cpp, `t_obs`), and refuses `deformation` (deformation.cpp).
 */
export function dated(pipeline: readonly StepText[]): Dated {
  let epoch: number | undefined;
  let undated = false;
  const steps: StepText[] = [];
  for (const step of pipeline) {
    const set = step.name === "set" && [...step.parameters.keys()].join() === "v_4";
    if (set) {
      epoch = Number(step.parameters.get("v_4"));
      continue;
    }
    const changes =
      step.name === "helmert" && RATES.some(([rate]) => Number(step.parameters.get(rate) ?? 0) !== 0);
    undated ||= changes && epoch === undefined;
    steps.push(at(step, epoch));
  }
  return { steps, undated };
}

/** A step as it is at an epoch. */
function at(step: StepText, epoch: number | undefined): StepText {
  const parameters = new Map(step.parameters);
  const own = Number(parameters.get("t_epoch") ?? Number.NaN);
  if (!Number.isFinite(own)) return step;
  if (step.name === "deformation" && epoch !== undefined) {
    parameters.delete("t_epoch");
    return { ...step, parameters: parameters.set("dt", `${epoch - own}`) };
  }
  if (step.name !== "helmert") return step;
  parameters.delete("t_epoch");
  for (const [rate, of] of RATES) {
    const perYear = Number(parameters.get(rate) ?? 0);
    parameters.delete(rate);
    if (perYear === 0 || epoch === undefined) continue;
    parameters.set(of, `${Number(parameters.get(of) ?? 0) + perYear * (epoch - own)}`);
  }
  return { ...step, parameters };
}
