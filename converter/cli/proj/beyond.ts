import {
  type Domain,
  EGM96_NOTE,
  type ShiftStep,
  type Transformation,
  type VerticalShiftStep,
  type Way,
} from "@groma/georef";
import { around } from "./elsewhere.js";

/** What points go by where the grid of a height system ends. */
export interface Beyond {
  /** The operation in plane, which leaves heights alone. */
  readonly operation: string;
  readonly accuracy: number | null;
  readonly transformation: Transformation;
  readonly geoid: VerticalShiftStep;
}

/**
 * A transformation that goes on where its grids end: by an operation in plane and EGM96. PROJ itself takes heights over as
 * they are there, tens of metres off.
 *
 * @returns nothing where the two do not end on the same ellipsoid
 */
export function goingOn(
  transformation: Transformation,
  { transformation: flat, geoid }: Beyond,
  domain: Domain,
): Transformation | undefined {
  const [projection, ...own] = transformation.steps;
  const [last, lastFlat] = [own.pop(), flat.steps[flat.steps.length - 1]];
  if (projection === undefined || last === undefined) return undefined;
  if (JSON.stringify(last) !== JSON.stringify(lastFlat)) return undefined;
  const everywhere = around(domain);
  const ways = own[0]?.kind === "choice" ? own[0].ways : [{ area: everywhere, steps: own as ShiftStep[] }];
  const beyond: Way = { area: everywhere, steps: [...(flat.steps.slice(1, -1) as ShiftStep[]), geoid] };
  return { steps: [projection, { kind: "choice", ways: [...ways, beyond] }, last] };
}

/** What a reader has to know of it. @param places ECEF of points spread over the bounds by the operation with the grids */
export function beyondNote({ operation }: Pick<Beyond, "operation">, places: Float64Array): string {
  const without = places.filter((value, i) => i % 3 === 0 && !Number.isFinite(value)).length;
  const percent = Math.max(1, Math.round((300 * without) / places.length));
  return `in ${percent} % of the data set's bounds, beyond the grids, points are placed by ${operation}; there ${EGM96_NOTE}`;
}
