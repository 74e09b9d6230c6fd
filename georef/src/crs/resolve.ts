import { requireFields } from "../errors/arguments.js";
import type { Crs, CrsNote, CrsSources, EpsgLookup, ResolvedCrs, Unit } from "./crs.js";
import { heightsOf, inWords, readDeclared, readDeclaredHeights, withHeights } from "./declared.js";
import { epsgCodes, readEpsg } from "./epsg.js";
import { withGivenVertical } from "./given-vertical.js";
import type { CrsModel, VerticalModel } from "./model.js";
import { heights, normalise } from "./normalise.js";
import { readProjString } from "./proj-string.js";
import { projJsonTree } from "./projjson.js";
import { atEpoch, Refusal, unknown } from "./refusal.js";
import { excerpt, parseWkt } from "./tree.js";
import { readWkt } from "./wkt.js";

/** As {@link resolveWithNotes}, the CRS alone. */
export function resolveCrs(sources: CrsSources, lookup?: EpsgLookup): Crs {
  return resolveWithNotes(sources, lookup).crs;
}

/**
 * The coordinate reference system of a file: what the user gives, else what the file declares.
 * A height reference given by the user replaces the one of the file, not its unit of z ({@link withGivenVertical}). A
 * given CRS that says nothing of heights leaves those of the file in force.
 *
 * @param lookup table of EPSG codes; without one, codes are refused as unknown
 * @throws CrsError CRS_MISSING (no source says anything), CRS_UNKNOWN (not understood), CRS_UNSUPPORTED (understood,
 *   but not done here: grids, other axes, other projections)
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function resolveWithNotes(sources: CrsSources, lookup?: EpsgLookup): ResolvedCrs {
  requireFields(
    sources,
    { file: "text?", wkt: "text?", given: "text?", givenVertical: "text?", geoTiff: "object?" },
    "resolveWithNotes: sources",
  );
  try {
    const wkt = textOf(sources.wkt);
    const given = textOf(sources.given);
    const vertical = textOf(sources.givenVertical);
    const own = { ...sources, wkt };
    const { model, basis, notes } =
      given === undefined ? fromFile(own, lookup) : fromUser(given, own, vertical === undefined, lookup);
    const text = basis === "given" ? given : basis === "WKT" ? wkt : undefined;
    const unitOfFile = () => declaredUnit(own, lookup);
    const settled =
      vertical === undefined ? { model, notes: [] } : withGivenVertical(model, vertical, unitOfFile, lookup);
    const crs = normalise(settled.model, lookup);
    return {
      ...{ crs: text !== undefined && isWkt(text) ? { ...crs, wkt: text } : crs, basis },
      notes: [...notes, ...settled.notes],
    };
  } catch (error) {
    if (error instanceof Refusal) throw error.toError(sources.file);
    throw error;
  }
}

/** VLRs are padded with NULs; a text of nothing but these is no text. */
function textOf(text: string | undefined): string | undefined {
  const trimmed = text?.replace(/\0/g, "").trim();
  return trimmed === "" ? undefined : trimmed;
}

type Found = Omit<ResolvedCrs, "crs"> & { readonly model: CrsModel };

function fromFile(sources: CrsSources, lookup: EpsgLookup | undefined): Found {
  const declared = readDeclared(sources, lookup);
  if (declared) return { ...declared, basis: declared.form };
  throw new Refusal("CRS_MISSING", "it does not say which coordinate reference system it is in");
}

/** @param keepHeights whether a CRS that names no heights has those of the file */
function fromUser(
  given: string,
  sources: CrsSources,
  keepHeights: boolean,
  lookup: EpsgLookup | undefined,
): Found {
  const model = readText(given, lookup);
  const kept = keepHeights && !heightsOf(model) ? heightsOfFile(sources, lookup) : undefined;
  if (!kept) return { model, basis: "given", notes: [] };
  return { model: withHeights(model, kept), basis: "given", notes: [noteOfKept(kept)] };
}

function noteOfKept(kept: VerticalModel): CrsNote {
  const text = `${inWords(kept)} is kept from the file: the coordinate reference system given names no heights`;
  return { code: "CRS_HEIGHTS_KEPT", text };
}

/**
 * A given CRS that was read elsewhere, with the heights that the file declares where it names none, as
 * {@link resolveWithNotes} keeps them. Its `wkt` stays that of the plane.
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function keepHeights(
  crs: Crs,
  sources: CrsSources,
  lookup?: EpsgLookup,
): Pick<ResolvedCrs, "crs" | "notes"> {
  requireFields(
    crs,
    { proj4: "text", horizontalUnit: "object", verticalUnit: "object", height: "object" },
    "keepHeights: crs",
  );
  const silent = crs.height.kind === "unknown" && !crs.verticalUnit.declared;
  const kept = silent ? heightsOfFile({ ...sources, wkt: textOf(sources.wkt) }, lookup) : undefined;
  if (!kept) return { crs, notes: [] };
  const code = crs.code !== undefined && kept.code !== undefined ? `${crs.code}+${kept.code}` : crs.code;
  const whole = { ...crs, ...heights({ kind: "projected", unit: crs.horizontalUnit }, kept) };
  return {
    crs: { ...whole, name: `${crs.name} + ${kept.name}`, ...(code !== undefined && { code }) },
    notes: [noteOfKept(kept)],
  };
}

/** The heights that a file declares, whatever it says of the plane. */
function heightsOfFile(sources: CrsSources, lookup: EpsgLookup | undefined): VerticalModel | undefined {
  const { recordedHeights: recorded } = sources;
  if (recorded && recorded.height.kind !== "unknown") {
    const { height, verticalUnit } = recorded;
    const unit = verticalUnit.declared ? verticalUnit : undefined;
    const name = height.kind === "geoid" ? height.model : "ellipsoidal height";
    const ellipsoid = height.kind === "ellipsoidal" ? height.ellipsoid : undefined;
    const code = height.kind === "geoid" ? height.epsg : undefined;
    return { name, code, unit, reference: height.kind, ellipsoid, doubt: height.doubt };
  }
  // A CRS may be given because that of the file cannot be used.
  return readDeclaredHeights(sources, lookup);
}

/** The unit of z that a file declares, whatever its heights are measured from. */
function declaredUnit(sources: CrsSources, lookup: EpsgLookup | undefined): Unit | undefined {
  const recorded = sources.recordedHeights?.verticalUnit;
  if (!recorded?.declared) return heightsOfFile(sources, lookup)?.unit;
  const { declared: _, ...unit } = recorded;
  return unit;
}

function isWkt(text: string): boolean {
  return /^[A-Za-z]\w*\s*\[/.test(text);
}

function readText(text: string, lookup: EpsgLookup | undefined): CrsModel {
  const codes = epsgCodes(text);
  if (codes) return readEpsg(codes, lookup);
  if (/^[A-Za-z]\w*:[\w.+:]+@\d{4}(\.\d+)?$/.test(text)) throw atEpoch();
  if (text.startsWith("{")) return readWkt([projJsonTree(text)]);
  if (isWkt(text)) return readWkt(parseWkt(text));
  const init = /\+init=(epsg:\d+)\b/i.exec(text);
  if (init) return readEpsg(epsgCodes(init[1])!, lookup);
  if (/\+?proj=/.test(text)) return readProjString(text);
  const cause = `"${excerpt(text)}" is no EPSG code, PROJ string, WKT or PROJJSON`;
  throw /^\d{4,6}(\+\d{4,6})?$/.test(text) ? unknown(cause, `give EPSG:${text}`) : unknown(cause);
}
