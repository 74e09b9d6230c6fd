import type { CrsNote, CrsSources, EpsgLookup } from "./crs.js";
import { readGeoTiff } from "./geotiff.js";
import type { CrsModel, VerticalModel } from "./model.js";
import { heights, normalise } from "./normalise.js";
import { Refusal } from "./refusal.js";
import { samePlane, sameSize, sameZero } from "./same.js";
import { parseWkt } from "./tree.js";
import { METRE } from "./units.js";
import { readWkt } from "./wkt.js";

/** The two forms in which a LAS file declares its CRS. */
export type Form = "WKT" | "GeoTIFF keys";

/** What a file declares, both forms seen together. */
export interface Declared {
  /** The form that the CRS comes from. */
  readonly form: Form;
  readonly model: CrsModel;
  readonly notes: readonly CrsNote[];
}

/** One form as it was read. */
interface Reading {
  readonly form: Form;
  readonly model?: CrsModel;
  readonly refusal?: Refusal;
}

/** A form that could be read. */
interface Readable extends Reading {
  readonly model: CrsModel;
}

/** Point data record formats that must have WKT (LAS 1.4 R15, 2.6). */
const FIRST_WITH_WKT = 6;

/**
 * The CRS that a file declares as WKT, as GeoTIFF keys, or as both. Which of the two is in force, the header of a LAS
 * file says: WKT for the point formats 6 to 10, else by bit 4 of the global encoding (LAS 1.4 R15, 2.4 and 2.6). Where
 * that form is absent or cannot be read, the other one is used. Heights that it does not declare are those of the other
 * form, unless the two contradict each other in plane. All of this is told in `notes`.
 *
 * @returns undefined where the file declares nothing
 * @throws Refusal of the form in force where neither can be used
 */
export function readDeclared(sources: CrsSources, lookup: EpsgLookup | undefined): Declared | undefined {
  const [first, second] = inOrder(sources, lookup);
  if (!first && !second) return undefined;
  if (!first?.model) {
    if (!isReadable(second)) throw (first ?? second)?.refusal;
    return { form: second.form, model: second.model, notes: [instead(first, second, sources)] };
  }
  if (!isReadable(first)) throw first.refusal;
  if (!isReadable(second)) return { form: first.form, model: first.model, notes: [] };
  return both(first, second, sources, lookup);
}

function isReadable(reading: Reading | undefined): reading is Readable {
  return reading?.model !== undefined;
}

/** The two forms, the one in force first; absent where the file does not have it. */
function inOrder(
  sources: CrsSources,
  lookup: EpsgLookup | undefined,
): [Reading | undefined, Reading | undefined] {
  const { wkt, geoTiff } = sources;
  const text = wkt === undefined ? undefined : reading("WKT", () => readWkt(parseWkt(wkt)));
  const keys = geoTiff && reading("GeoTIFF keys", () => readGeoTiff(geoTiff, lookup));
  return formInForce(sources) === "WKT" ? [text, keys] : [keys, text];
}

function formInForce({ las }: CrsSources): Form {
  return !las || las.pointFormat >= FIRST_WITH_WKT || las.wktBit ? "WKT" : "GeoTIFF keys";
}

function reading(form: Form, read: () => CrsModel | undefined): Reading | undefined {
  try {
    const model = read();
    return model && { form, model };
  } catch (error) {
    if (error instanceof Refusal) return { form, refusal: error };
    throw error;
  }
}

/** Says why the form that is not in force is used. */
function instead(first: Reading | undefined, { form }: Reading, { las }: CrsSources): CrsNote {
  const other = form === "WKT" ? "GeoTIFF keys" : "WKT";
  const used = form === "WKT" ? "the WKT is used" : "the keys are used";
  if (first) {
    const text = `the ${other} cannot be used (${first.refusal?.message}): the ${form} ${form === "WKT" ? "is" : "are"} used instead`;
    return { code: "CRS_OTHER_FORM", text };
  }
  const announced =
    form === "WKT"
      ? "the WKT bit of the header is not set, which announces GeoTIFF keys"
      : las && las.pointFormat >= FIRST_WITH_WKT
        ? `point format ${las.pointFormat} requires WKT`
        : "the header announces WKT";
  return { code: "CRS_OTHER_FORM", text: `${announced}, but the file has ${form} only: ${used}` };
}

function both(
  first: Readable,
  second: Readable,
  sources: CrsSources,
  lookup: EpsgLookup | undefined,
): Declared {
  const { form, model } = first;
  const apart = differentPlane(model, second.model, lookup);
  if (apart || differentHeights(model, second.model)) {
    return { form, model, notes: [contradiction(first, second, sources)] };
  }
  const own = heightsOf(model);
  const completed = complete(own, heightsOf(second.model));
  if (!completed || completed === own) return { form, model, notes: [] };
  const text = `the ${form} ${form === "WKT" ? "does" : "do"} not declare all of the heights: ${inWords(completed)} is taken from the ${second.form}`;
  return {
    ...{ form, model: withHeights(model, completed) },
    notes: [{ code: "CRS_HEIGHTS_FROM_OTHER_FORM", text }],
  };
}

function contradiction({ form, model }: Readable, second: Readable, { las }: CrsSources): CrsNote {
  const used = form === "WKT" ? "the WKT is used" : "the GeoTIFF keys are used";
  const why = !las
    ? ""
    : las.pointFormat >= FIRST_WITH_WKT
      ? `, as point format ${las.pointFormat} requires`
      : `, since the WKT bit of the header is ${las.wktBit ? "set" : "not set"}`;
  const described = (one: Readable) => {
    const unit = heightsOf(one.model)?.unit;
    return `${one.model.name}${unit ? `, z in ${unit.name}` : ""}`;
  };
  const [own, other] = [described({ form, model }), described(second)];
  const text = `the ${form} (${own}) and the ${second.form} (${other}) contradict each other; ${used}${why}`;
  return { code: "CRS_CONTRADICTION", text };
}

function differentPlane(a: CrsModel, b: CrsModel, lookup: EpsgLookup | undefined): boolean {
  try {
    return !samePlane(normalise(a, lookup), normalise(b, lookup));
  } catch (error) {
    // What cannot be used contradicts nothing; the form in force is refused by whoever uses it.
    if (error instanceof Refusal) return false;
    throw error;
  }
}

/** Whether both declare heights, and others. */
function differentHeights(a: CrsModel, b: CrsModel): boolean {
  const [first, second] = [heightsOf(a), heightsOf(b)];
  if (!first || !second) return false;
  if (first.unit && second.unit && !sameSize(first.unit.size, second.unit.size)) return true;
  if (first.reference === "unknown" || second.reference === "unknown") return false;
  return !sameZero(heights(a.horizontal, first).height, heights(b.horizontal, second).height);
}

/** The heights that a CRS declares, those of its own third axis included. */
export function heightsOf({ horizontal, vertical }: CrsModel): VerticalModel | undefined {
  if (vertical) return vertical;
  if (horizontal.kind === "geocentric") return ELLIPSOIDAL;
  const { heightUnit: unit } = horizontal;
  return unit && { ...ELLIPSOIDAL, unit };
}

const ELLIPSOIDAL: VerticalModel = { name: "ellipsoidal height", reference: "ellipsoidal", unit: METRE };

/** What one declares of heights, completed by what another one does. */
function complete(
  own: VerticalModel | undefined,
  other: VerticalModel | undefined,
): VerticalModel | undefined {
  if (!own || !other) return own ?? other;
  if (own.reference === "unknown" && other.reference !== "unknown") {
    return { ...other, unit: own.unit ?? other.unit };
  }
  return own.unit || !other.unit ? own : { ...own, unit: other.unit };
}

/** A CRS with other heights; its code as a whole was that with its own ones. */
export function withHeights(model: CrsModel, vertical: VerticalModel): CrsModel {
  return { ...model, name: `${model.horizontal.name} + ${vertical.name}`, code: undefined, vertical };
}

/** A height reference with its unit. */
export function inWords({ name, reference, unit }: VerticalModel): string {
  if (reference === "unknown") return `the unit of heights (${unit?.name})`;
  return unit ? `${name} (${unit.name})` : name;
}
