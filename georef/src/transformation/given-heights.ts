import { choiceOf } from "./choice.js";
import type { ChoiceStep, ShiftStep, Step, Transformation, VerticalShiftStep } from "./step.js";

/** What heights are measured from, in place of what a transformation was made for. */
export interface GivenHeights {
  /** Of one unit of z. */
  readonly metresPerUnit: number;
  /** From there to the WGS 84 ellipsoid; absent where they stand on it. */
  readonly geoid?: VerticalShiftStep | undefined;
}

/**
 * The same way in plane with other heights. As PROJ does it for a CRS whose heights are settled apart (push and pop of
 * v_3), the steps in plane leave heights alone, and what stands for them is put before the last step.
 */
export function withHeights(
  { steps }: Transformation,
  { metresPerUnit, geoid }: GivenHeights,
): Transformation {
  const [projection, ...others] = steps;
  const height: ShiftStep[] = metresPerUnit === 1 ? [] : [{ kind: "height", metresPerUnit }];
  const choice = choiceOf({ steps });
  const inPlane = others.flatMap((step): readonly Step[] => {
    if (step.kind !== "choice") return planeOf(step);
    const ways = step.ways.map((way) => ({ ...way, steps: [...height, ...way.steps.flatMap(planeOf)] }));
    return [{ ...step, ways }];
  });
  return {
    steps: [
      projection,
      ...(choice ? [] : height),
      ...inPlane.slice(0, -1),
      ...(geoid ? [geoid] : []),
      inPlane[inPlane.length - 1],
    ],
  };
}

/** What a step does in plane; nothing of one that changes heights alone. */
function planeOf<Kind extends Exclude<Step, ChoiceStep>>(step: Kind): Kind[] {
  if (step.kind === "height" || step.kind === "verticalShift") return [];
  return [step.kind === "datumShift" ? { ...step, keepHeight: true } : step];
}
