import type { Transformation, VerticalShiftStep } from "./step.js";

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
  const inPlane = others.filter(({ kind }) => kind !== "height" && kind !== "verticalShift");
  return {
    steps: [
      projection,
      ...(metresPerUnit === 1 ? [] : [{ kind: "height", metresPerUnit } as const]),
      ...inPlane
        .slice(0, -1)
        .map((step) => (step.kind === "datumShift" ? { ...step, keepHeight: true } : step)),
      ...(geoid ? [geoid] : []),
      inPlane[inPlane.length - 1],
    ],
  };
}
