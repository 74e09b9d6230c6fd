import type { CrsNote, EpsgLookup, Unit } from "./crs.js";
import { heightsOf, withHeights } from "./declared.js";
import { epsgCodes, readEpsgVertical } from "./epsg.js";
import type { CrsModel, VerticalModel } from "./model.js";
import { unknown } from "./refusal.js";
import { sameSize } from "./same.js";
import { excerpt } from "./tree.js";
import { directed, METRE } from "./units.js";

/** A CRS with the height reference that the user gives, and what has to be known of the unit of z. */
interface WithVertical {
  readonly model: CrsModel;
  readonly notes: readonly CrsNote[];
}

/**
 * A CRS with the height reference that the user gives. That says what z is measured from. The unit of z stays the one
 * that the CRS or the file declares. Where neither does, it is that of the given system, which the codes of systems in
 * feet say on purpose; only where that is the metre and the plane is in another unit of length, z has the plane's, as it
 * has without a height reference. Whenever the unit is not the one of the given system, or not the plane's, a note
 * CRS_HEIGHT_UNIT says which it is.
 *
 * @param text `EPSG:5728` or `ellipsoidal`
 * @param unitOfFile the unit of z that the file declares
 * @throws Refusal CRS_UNKNOWN, CRS_UNSUPPORTED
 */
export function withGivenVertical(
  model: CrsModel,
  text: string,
  unitOfFile: () => Unit | undefined,
  lookup: EpsgLookup | undefined,
): WithVertical {
  const given = readGiven(text, lookup);
  const declared = heightsOf(model)?.unit ?? unitOfFile();
  const down = (given.unit?.size ?? 1) < 0;
  const unit = declared ?? assumedUnit(given, model) ?? (down ? planeUnit(model) : undefined);
  const vertical = { ...given, unit: unit && directed(unit, down) };
  const note = noteOf(given, model, declared);
  return {
    model: withHeights(model, vertical),
    notes: note === undefined ? [] : [{ code: "CRS_HEIGHT_UNIT", text: note }],
  };
}

function readGiven(text: string, lookup: EpsgLookup | undefined): VerticalModel {
  if (text.toLowerCase() === "ellipsoidal") return { name: "ellipsoidal height", reference: "ellipsoidal" };
  const codes = epsgCodes(text);
  if (codes && codes[1] === undefined) return readEpsgVertical(codes[0], lookup);
  throw unknown(
    `"${excerpt(text)}" is not a known height reference`,
    "give a vertical EPSG code such as EPSG:5728, or ellipsoidal",
  );
}

/** The unit of z that the given system says; nothing where the plane's is to be assumed. */
function assumedUnit({ unit }: VerticalModel, model: CrsModel): Unit | undefined {
  return unit && (!sameLength(unit, METRE) || sameLength(planeUnit(model), METRE)) ? unit : undefined;
}

/** The unit that z has where nothing says one. */
function planeUnit({ horizontal: { unit } }: CrsModel): Unit {
  return unit.kind === "linear" ? unit : METRE;
}

function noteOf(given: VerticalModel, model: CrsModel, declared: Unit | undefined): string | undefined {
  const own = given.unit ?? METRE;
  const plane = planeUnit(model);
  const itself = given.reference === "ellipsoidal" ? "" : `; ${given.name} itself is in ${own.name}`;
  if (declared) {
    if (sameLength(declared, own)) return undefined;
    return `z stays in ${declared.name}, as declared${itself}${otherWay(given, model, own)}`;
  }
  if (sameLength(plane, own)) return undefined;
  if (assumedUnit(given, model)) {
    return `z is taken in ${own.name}, the unit of ${given.name}: no unit of z is declared, and the plane is in ${plane.name}`;
  }
  return `z is taken in ${plane.name}, the unit of the plane, since none is declared${itself}${otherWay(given, model, own)}`;
}

/** Whether two units are one, whichever way they count. */
function sameLength(a: Unit, b: Unit): boolean {
  return sameSize(Math.abs(a.size), Math.abs(b.size));
}

/** How to say that z is in the unit of the given system. */
function otherWay(given: VerticalModel, { horizontal: { code } }: CrsModel, own: Unit): string {
  if (given.reference === "ellipsoidal") return "";
  const both = code === undefined ? "" : ` (EPSG:${code}+${given.code})`;
  return `. If z is in ${own.name}, give plane and heights as one coordinate reference system${both}`;
}
