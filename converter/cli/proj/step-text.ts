import { CrsError } from "@groma/georef";

/** One step of a PROJ pipeline as it is written. */
export interface StepText {
  /** Name of the operation or projection, what stands behind `+proj=`. */
  readonly name: string;
  readonly inverse: boolean;
  /** The other parameters; flags such as `+v_3` have the value "". */
  readonly parameters: ReadonlyMap<string, string>;
}

/** Degrees to radians, in the plane. */
export const TO_RADIANS: StepText = {
  name: "unitconvert",
  inverse: false,
  parameters: new Map([
    ["xy_in", "deg"],
    ["xy_out", "rad"],
  ]),
};

/** Longer than any pipeline that PROJ writes. */
const LENGTH_MAX = 20_000;
const TOKEN = /^\+?([A-Za-z_][A-Za-z0-9_]*)(?:=([A-Za-z0-9_.,:@/+-]*))?$/;

/**
 * Splits a PROJ string into its steps; one without `+proj=pipeline` is one step.
 *
 * @throws CrsError CRS_OPERATION_UNSUPPORTED when it is no such string, or sets parameters for all steps at once
 */
export function splitPipeline(text: string): StepText[] {
  if (text.length > LENGTH_MAX) throw unreadable(text, "is too long");
  const steps: { name?: string; inverse: boolean; parameters: Map<string, string> }[] = [];
  let pipeline = false;
  for (const token of text.split(/\s+/).filter((part) => part !== "")) {
    const found = TOKEN.exec(token);
    if (!found) throw unreadable(text, `has the word "${token.slice(0, 60)}"`);
    const [, key, value = ""] = found;
    if (key === "step") {
      if (!pipeline) throw unreadable(text, "has a step outside of a pipeline");
      steps.push({ inverse: false, parameters: new Map() });
      continue;
    }
    if (key === "proj" && value === "pipeline") {
      if (pipeline || steps.length > 0) throw unreadable(text, "has a pipeline within a pipeline");
      pipeline = true;
      continue;
    }
    if (steps.length === 0) {
      if (pipeline) throw unreadable(text, `sets +${key} for the whole pipeline`);
      steps.push({ inverse: false, parameters: new Map() });
    }
    const step = steps[steps.length - 1];
    if (key === "proj" && step.name === undefined) step.name = value;
    else if (key === "inv" && value === "") step.inverse = true;
    else if (key === "proj" || key === "init" || step.parameters.has(key)) {
      throw unreadable(text, `says +${key} where it has no meaning`);
    } else step.parameters.set(key, value);
  }
  const named = steps.map(({ name, inverse, parameters }) => {
    if (!name) throw unreadable(text, "has a step without a name");
    return { name, inverse, parameters };
  });
  if (named.length === 0) throw unreadable(text, "has no step");
  return named;
}

/** The words of a pipeline, each an argument of `cct`. */
export function pipelineWords(steps: readonly StepText[]): string[] {
  const words = ["+proj=pipeline"];
  for (const { name, inverse, parameters } of steps) {
    words.push("+step", ...(inverse ? ["+inv"] : []), `+proj=${name}`);
    for (const [key, value] of parameters) words.push(value === "" ? `+${key}` : `+${key}=${value}`);
  }
  return words;
}

function unreadable(text: string, what: string): CrsError {
  return new CrsError({
    code: "CRS_OPERATION_UNSUPPORTED",
    file: "PROJ",
    cause: `the operation "${text.slice(0, 120)}" ${what}`,
    fix: "give the coordinate reference system as an EPSG code, or convert with --engine proj4js",
  });
}
