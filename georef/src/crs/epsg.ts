import type { EpsgEntry, EpsgLookup } from "./crs.js";
import { findDatumShift, translation } from "./datum-table.js";
import type { CrsModel, HorizontalModel, VerticalModel } from "./model.js";
import { readProjString } from "./proj-string.js";
import { type Refusal, unknown, unsupported } from "./refusal.js";
import { parseWkt } from "./tree.js";
import { GRAD } from "./units.js";
import { readWkt } from "./wkt.js";
import { readVertical, VERTICAL } from "./wkt-vertical.js";

/** `EPSG:2056` or `EPSG:2056+5728`, with or without the second `EPSG:`. */
const CODES = /^\s*EPSG:(\d{1,6})(?:\s*\+\s*(?:EPSG:)?(\d{1,6}))?\s*$/i;

/** The codes that a text names, or undefined when it is no EPSG code. */
export function epsgCodes(text: string): readonly [horizontal: number, vertical?: number] | undefined {
  const match = CODES.exec(text);
  if (!match) return undefined;
  return match[2] === undefined ? [Number(match[1])] : [Number(match[1]), Number(match[2])];
}

/** CRS of one or two EPSG codes. @throws Refusal */
export function readEpsg(
  [horizontal, vertical]: readonly [number, number?],
  lookup: EpsgLookup | undefined,
): CrsModel {
  const model = readEpsgHorizontal(horizontal, lookup);
  if (vertical === undefined) return model;
  const height = readEpsgVertical(vertical, lookup);
  return {
    name: `${model.horizontal.name} + ${height.name}`,
    horizontal: model.horizontal,
    vertical: height,
  };
}

/** CRS of a code that has a horizontal part, compound ones included. @throws Refusal */
function readEpsgHorizontal(code: number, lookup: EpsgLookup | undefined): CrsModel {
  const entry = find(code, lookup);
  if (entry.kind === "CRS-VERTCRS") {
    throw unsupported(
      `EPSG:${code} (${entry.name}) is a height system alone`,
      "give a horizontal one with it, for example EPSG:2056+5728",
    );
  }
  const model = entry.wkt ? readWkt(parseWkt(entry.wkt)) : readProjString(required(entry.proj4, code));
  const horizontal = inGrads(code, ownShift(model.horizontal));
  if (entry.kind === "CRS-COMPOUNDCRS") return { ...model, name: entry.name, code, horizontal };
  const heightUnit = horizontal.heightUnit ?? thirdAxis(entry);
  return {
    ...model,
    name: entry.name,
    code,
    horizontal: { ...horizontal, name: entry.name, code, heightUnit },
  };
}

/**
 * Geographic systems of EPSG that count in grads (coordinate system 6403) and that tables have as PROJ strings alone, which
 * cannot say so: NTF, Tananarive 1925, Voirol 1875 and Carthage, all from Paris.
 */
const IN_GRADS: ReadonlySet<number> = new Set([4807, 4810, 4811, 4816]);

function inGrads(code: number, model: HorizontalModel): HorizontalModel {
  return IN_GRADS.has(code) ? { ...model, unit: GRAD } : model;
}

/**
 * A table's shift is its author's choice, and tables err: one in wide use has the rotations of coordinate frame
 * transformations with the wrong sign and microradians as arc-seconds, 200 m off in the Netherlands. Where the datum is
 * known here its own shift stands (also in place of a grid, with its stated accuracy); of the others only
 * translations are believed.
 */
function ownShift(model: HorizontalModel): HorizontalModel {
  const { datum } = model;
  if (findDatumShift(datum.name, datum.code)) {
    return { ...model, datum: { ...datum, towgs84: undefined, grid: undefined } };
  }
  return { ...model, datum: { ...datum, towgs84: translation(datum.towgs84) } };
}

/** A table in WKT1 cannot say that a geographic CRS has three dimensions; its kind can. */
function thirdAxis({ kind }: EpsgEntry): HorizontalModel["heightUnit"] {
  return kind === "CRS-GEOG3DCRS" ? { name: "metre", kind: "linear", size: 1 } : undefined;
}

/** Vertical CRS of a code. @throws Refusal */
export function readEpsgVertical(code: number, lookup: EpsgLookup | undefined): VerticalModel {
  const entry = find(code, lookup);
  if (entry.kind !== "CRS-VERTCRS") {
    throw unsupported(
      `EPSG:${code} (${entry.name}) is not a height system`,
      "give a vertical one, for example EPSG:5728",
    );
  }
  const node = entry.wkt ? parseWkt(entry.wkt)[0] : undefined;
  if (!node || !VERTICAL.includes(node[0])) return { name: entry.name, code, reference: "geoid" };
  return { ...readVertical(node), code };
}

function find(code: number, lookup: EpsgLookup | undefined): EpsgEntry {
  if (!lookup) {
    const fix = "give it as WKT or as a PROJ string";
    throw unknown(`EPSG:${code} cannot be looked up: no table of EPSG codes is at hand`, fix);
  }
  const entry = lookup(code);
  if (!entry) throw notThere(code);
  return entry;
}

function required(proj4: string | undefined, code: number): string {
  if (!proj4) throw notThere(code);
  return proj4;
}

function notThere(code: number): Refusal {
  return unknown(`EPSG:${code} is not in the table of EPSG codes`, "check the code, or give the CRS as WKT");
}
