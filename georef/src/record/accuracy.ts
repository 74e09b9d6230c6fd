import type { Crs } from "../crs/crs.js";
import { WGS84 } from "../ellipsoid/ellipsoid.js";

/** One named part of what a stated position is worth. */
export interface AccuracyPart {
  readonly name: string;
  /** Metres; `null` when it is not known. */
  readonly metres: number | null;
  readonly note?: string;
}

/** The parts and their sum; the sum is `null` as soon as one part is not known. */
export interface StatedAccuracy {
  readonly total: number | null;
  readonly parts: readonly AccuracyPart[];
}

/** Sums the parts linearly: they are bounds and stated accuracies, not independent deviations. */
export function statedAccuracy(parts: readonly AccuracyPart[]): StatedAccuracy {
  let total: number | null = 0;
  for (const { metres } of parts) total = total === null || metres === null ? null : total + metres;
  return { total, parts };
}

/**
 * The parts of a data set's accuracy that follow from its CRS, the LAS scale factors and the tolerance of its
 * placement: quantisation, fit, datum operation, height.
 *
 * @param scale LAS scale factors, 3 values, source units
 * @param fitBound certified bound of the placement, metres (the tolerance, while no node is placed yet)
 */
export function accuracyParts(
  crs: Pick<Crs, "horizontalUnit" | "verticalUnit" | "height" | "datum">,
  scale: ArrayLike<number>,
  fitBound: number,
): AccuracyPart[] {
  return [
    { name: "quantisation", metres: quantisation(crs, scale), note: "half a step of the stored integers" },
    { name: "fit", metres: fitBound, note: "certified, rounding to float32 included" },
    datumPart(crs.datum),
    heightPart(crs.height),
  ];
}

/** Half a step per axis, taken together; degrees count as their length along the equator. */
function quantisation(
  { horizontalUnit, verticalUnit }: Pick<Crs, "horizontalUnit" | "verticalUnit">,
  scale: ArrayLike<number>,
): number {
  const metres = horizontalUnit.size * (horizontalUnit.kind === "angular" ? WGS84.a : 1);
  return Math.hypot(scale[0] * metres, scale[1] * metres, scale[2] * verticalUnit.size) / 2;
}

function datumPart(datum: Crs["datum"]): AccuracyPart {
  if (!datum) return { name: "datum operation", metres: null, note: "not stated" };
  return { name: "datum operation", metres: datum.accuracy, note: datum.operation };
}

function heightPart(height: Crs["height"]): AccuracyPart {
  if (height.kind === "ellipsoidal") return { name: "height", metres: 0, note: "ellipsoidal" };
  if (height.kind === "unknown") {
    return { name: "height", metres: null, note: "reference unknown, drawn as ellipsoidal" };
  }
  return { name: "height", metres: null, note: `${height.model}: drawn without its geoid` };
}
