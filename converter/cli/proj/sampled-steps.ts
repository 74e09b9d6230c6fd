import type { EllipsoidText, PlannedStep } from "./plan.js";
import type { StepText } from "./step-text.js";

/** Steps whose tables and triangles are not read here, on the ellipsoid and in space. */
const SAMPLED = new Set(["gridshift", "tinshift", "vertoffset"]);
const SAMPLED_IN_SPACE = new Set(["deformation", "xyzgridshift"]);
/** Parameters that ask for the time of a point, which scans do not have. */
const BY_TIME = /^(t_epoch|t_final|t_obs|d[xyzs]|dr[xyz]|dtheta)$/;

/**
 * The steps from one on, up to where coordinates are longitude and latitude in radians again, if one of them is among those
 * that are taken as PROJ gives them.
 *
 * @param start a step before which coordinates are longitude, latitude in radians and height in metres
 */
export function sampledFrom(
  pipeline: readonly StepText[],
  start: number,
): Extract<PlannedStep, { kind: "sampled" }> | undefined {
  let [radians, swapped, aside, inSpace] = [true, false, false, false];
  let [from, to]: (EllipsoidText | undefined)[] = [];
  let keepHeight = false;
  for (let i = start; i < pipeline.length; i++) {
    const { name, inverse, parameters } = pipeline[i]!;
    if ([...parameters.keys()].some((key) => BY_TIME.test(key))) return undefined;
    if (SAMPLED.has(name) ? inSpace : SAMPLED_IN_SPACE.has(name) && !inSpace) return undefined;
    if (name === "unitconvert") {
      const unit = parameters.get(inverse ? "xy_in" : "xy_out");
      if (unit !== undefined) radians = unit === "rad";
    } else if (name === "axisswap") {
      if (parameters.get("order") !== "2,1") return undefined;
      swapped = !swapped;
    } else if (name === "push" || name === "pop") {
      if ([...parameters.keys()].join() !== "v_3") return undefined;
      aside = (name === "push") !== inverse;
      keepHeight ||= aside;
    } else if (name === "cart") {
      inSpace = !inverse;
      if (inSpace) from ??= parameters;
      else to = parameters;
    }
    if (!radians || swapped || aside || inSpace) continue;
    const steps = pipeline.slice(start, i + 1);
    if (!steps.some((step) => SAMPLED.has(step.name) || SAMPLED_IN_SPACE.has(step.name))) return undefined;
    const space = from && to && { from, to, keepHeight };
    return { kind: "sampled", before: start, after: i + 1, ...(space && { space }) };
  }
  return undefined;
}
