import { type AreaOfUse, areOverlapping } from "./area-of-use.js";
import type { DatumOperation } from "./crs.js";
import { DATUM_AREAS } from "./datum-areas.js";
import { DATUM_SPREAD } from "./datum-spread.js";
import { type DatumShift, findDatumShift } from "./datum-table.js";

/**
 * What the one shift of a datum is worth in an area, metres: its published accuracy, or, where other operations hold for
 * parts of the area, its distance from the farthest of these with that one's accuracy, if that is more.
 *
 * @param area all of the datum's where it is not known
 */
export function shiftAccuracy({ code, accuracy }: Pick<DatumShift, "code" | "accuracy">, area?: AreaOfUse) {
  const parts = DATUM_SPREAD.get(code) ?? [];
  const there = area
    ? parts.filter(([west, south, east, north]) => areOverlapping([west, south, east, north], area))
    : parts;
  const counted = there.length > 0 ? there : parts;
  return Math.max(accuracy, ...counted.map(([, , , , metres]) => metres));
}

/**
 * What a CRS's way to WGS 84 is worth in the area of a data set, metres; `null` when nobody has stated it, and outside of
 * the datum's area of use, where its shift may be hundreds of metres off.
 *
 * @param area undefined where no place is known
 */
export function accuracyIn(datum: DatumOperation | undefined, area: AreaOfUse | undefined): number | null {
  const shift = datum?.datum === undefined ? undefined : findDatumShift("", datum.datum);
  if (!shift || !area) return datum?.accuracy ?? null;
  const use = DATUM_AREAS.get(shift.code);
  return use && !areOverlapping(use, area) ? null : shiftAccuracy(shift, area);
}

/** The accuracy that is published for a CRS's way to WGS 84, metres, wherever it is used. */
export function publishedAccuracy({ datum, accuracy }: DatumOperation): number | null {
  return (datum === undefined ? undefined : findDatumShift("", datum)?.accuracy) ?? accuracy;
}
