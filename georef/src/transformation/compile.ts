import { bilinear, type Surface } from "../grid/surface.js";
import { choiceLink, choiceOf } from "./choice.js";
import { datumShiftLink, geocentricLink, heightLink } from "./ellipsoid-links.js";
import type { Link } from "./link.js";
import { projectionLink } from "./projection.js";
import { horizontalShiftLink, verticalShiftLink } from "./shift-links.js";
import type { ChoiceStep, HorizontalShiftStep, Step, Transformation, VerticalShiftStep } from "./step.js";

/** A step that looks something up in a grid. */
export type GridStep = HorizontalShiftStep | VerticalShiftStep;

/** What stands for a grid; by default the grid itself. */
export type SurfaceOf = (step: GridStep) => Surface;

/** The window of a step, holes treated as PROJ treats them in grids of its kind. */
function surfaceOfWindow({ kind, window }: GridStep): Surface {
  return bilinear(window, kind === "verticalShift" ? "renormalised" : "refused");
}

/** Compiles one step. */
export function linkOf(step: Exclude<Step, ChoiceStep>, surfaceOf: SurfaceOf = surfaceOfWindow): Link {
  switch (step.kind) {
    case "projection":
      return projectionLink(step.patchwork);
    case "height":
      return heightLink(step);
    case "horizontalShift":
      return horizontalShiftLink(step, surfaceOf(step));
    case "verticalShift":
      return verticalShiftLink(step, surfaceOf(step));
    case "datumShift":
      return datumShiftLink(step);
    case "geocentric":
      return geocentricLink(step);
  }
}

/** Compiles all steps; the projection and a choice after it are one link. @param end takes the place of the step to ECEF */
export function linksOf({ steps }: Pick<Transformation, "steps">, end?: Link): Link[] {
  const choice = choiceOf({ steps });
  return steps.flatMap((step): Link[] => {
    if (step.kind === "choice") return [];
    if (choice && step === steps[0]) return [choiceLink(linkOf(step), choice, linkOf)];
    return [end && step.kind === "geocentric" ? end : linkOf(step)];
  });
}
