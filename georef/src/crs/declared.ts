import type { CrsNote, CrsSources, EpsgLookup } from "./crs.js";
import { readGeoTiff, readGeoTiffHeights } from "./geotiff.js";
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
 * form, unless the two contradict each other in plane; keys may declare nothing but heights. All of this is told in `notes`.
 *
 * @returns undefined where the file declares nothing
 * @throws Refusal of the form in force where neither can be used
 */
export function readDeclared(sources: CrsSources, lookup: EpsgLookup | undefined): Declared | undefined {
  const forms = inOrder(sources, lookup);
  const declared = ofForms(forms, sources, lookup);
  if (declared?.form !== "WKT" || forms.some((one) => one?.form === "GeoTIFF keys" && one.model)) {
    return declared;
  }
  const alone = heightsInKeys(sources, lookup);
  if (!alone) return declared;
  const { form, model, notes } = declared;
  const own = heightsOf(model);
  if (own && differentHeights(model, own, alone)) {
    const other = { form: "GeoTIFF keys", words: inWords(alone) } as const;
    return { form, model, notes: [...notes, contradiction({ form, words: inFull(model) }, other, sources)] };
  }
  const whole = completed(model, form, alone, "GeoTIFF keys");
  return { ...whole, notes: [...notes, ...whole.notes] };
}

/** The heights that a file declares, whatever it says of the plane. */
export function readDeclaredHeights(
  sources: CrsSources,
  lookup: EpsgLookup | undefined,
): VerticalModel | undefined {
  try {
    const declared = readDeclared(sources, lookup);
    if (declared) return heightsOf(declared.model);
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
  }
  return heightsInKeys(sources, lookup);
}

/** The heights of keys whose plane is missing or cannot be read. */
function heightsInKeys({ geoTiff }: CrsSources, lookup: EpsgLookup | undefined): VerticalModel | undefined {
  try {
    return geoTiff && readGeoTiffHeights(geoTiff, lookup);
  } catch (error) {
    if (error instanceof Refusal) return undefined;
    throw error;
  }
}

type Forms = readonly [first: Reading | undefined, second: Reading | undefined];

function ofForms(
  [first, second]: Forms,
  sources: CrsSources,
  lookup: EpsgLookup | undefined,
): Declared | undefined {
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
function inOrder(sources: CrsSources, lookup: EpsgLookup | undefined): Forms {
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
  const [own, other] = [heightsOf(model), heightsOf(second.model)];
  const apart = differentPlane(model, second.model, lookup);
  if (apart || (own && other && differentHeights(model, own, other))) {
    const [one, two] = [first, second].map((each) => ({ form: each.form, words: inFull(each.model) }));
    return { form, model, notes: [contradiction(one, two, sources)] };
  }
  return completed(model, form, other, second.form);
}

/** What one form declares, its heights completed by those of the other one. */
function completed(model: CrsModel, form: Form, other: VerticalModel | undefined, from: Form): Declared {
  const own = heightsOf(model);
  const whole = complete(own, other);
  if (!whole || whole === own) return { form, model, notes: [] };
  const text = `the ${form} ${form === "WKT" ? "does" : "do"} not declare all of the heights: ${inWords(whole)} is taken from the ${from}`;
  return {
    ...{ form, model: withHeights(model, whole) },
    notes: [{ code: "CRS_HEIGHTS_FROM_OTHER_FORM", text }],
  };
}

/** What a form says, for people. */
interface Said {
  readonly form: Form;
  readonly words: string;
}

function contradiction({ form, words }: Said, second: Said, { las }: CrsSources): CrsNote {
  const used = form === "WKT" ? "the WKT is used" : "the GeoTIFF keys are used";
  const why = !las
    ? ""
    : las.pointFormat >= FIRST_WITH_WKT
      ? `, as point format ${las.pointFormat} requires`
      : `, since the WKT bit of the header is ${las.wktBit ? "set" : "not set"}`;
  const text = `the ${form} (${words}) and the ${second.form} (${second.words}) contradict each other; ${used}${why}`;
  return { code: "CRS_CONTRADICTION", text };
}

/** A CRS with its unit of z. */
function inFull(model: CrsModel): string {
  const unit = heightsOf(model)?.unit;
  return `${model.name}${unit ? `, z in ${unit.name}` : ""}`;
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

/** Whether the heights of two declarations of one plane contradict each other. */
function differentHeights({ horizontal }: CrsModel, first: VerticalModel, second: VerticalModel): boolean {
  if (first.unit && second.unit && !sameSize(first.unit.size, second.unit.size)) return true;
  if (first.reference === "unknown" || second.reference === "unknown") return false;
  return !sameZero(heights(horizontal, first).height, heights(horizontal, second).height);
}

/** The heights that a CRS declares, those of its own third axis included. */
export function heightsOf({ horizontal, vertical }: CrsModel): VerticalModel | undefined {
  if (vertical) return vertical;
  if (horizontal.kind === "geocentric") return ELLIPSOIDAL;
  const { heightUnit: unit } = horizontal;
  return unit && { ...ELLIPSOIDAL, unit, ellipsoid: "own" };
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
