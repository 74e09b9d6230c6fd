import { requireFields, requireKind } from "../errors/arguments.js";
import type { EpsgEntry, EpsgLookup } from "./crs.js";
import { translation } from "./datum-table.js";
import { shiftOfProjString } from "./proj-string.js";
import {
  child,
  children,
  epsgCode,
  isNode,
  number,
  parseWkt,
  text,
  type WktItem,
  type WktNode,
} from "./tree.js";

/** A table of EPSG in little: what all its systems share is written once. JSON has it as it is. */
export interface PackedEpsg {
  /** Datum, meridian and unit of geographic systems, as WKT. */
  readonly bases: readonly string[];
  /** Methods of projection with their parameters and axes, as WKT with `#` for each number of a parameter. */
  readonly methods: readonly string[];
  /** Kind, code, name, index of the base. */
  readonly geodetic: readonly (readonly [kind: string, code: number, name: string, base: number])[];
  /** Code, name, code of the geographic system (0: none), indices of base and method, numbers of the parameters. */
  readonly projected: readonly (readonly [number, string, number, number, number, ...number[]])[];
  /** Code, name, codes of the horizontal and the vertical part. */
  readonly compound: readonly (readonly [number, string, number, number])[];
  /** Kind, code, name and PROJ string of what the table has no WKT of. */
  readonly strings: readonly (readonly [kind: string, code: number, name: string, proj4: string])[];
  /** Code and shift to WGS 84, metres, where the table has a translation. */
  readonly shifts: readonly (readonly [number, ...number[]])[];
}

/** A row of an EPSG table. */
interface Row extends EpsgEntry {
  readonly code: number | string;
}

/** The greatest code that a GeoTIFF key can name. */
const GREATEST = 65535;
const GEODETIC = ["CRS-GEOGCRS", "CRS-GEOG3DCRS", "CRS-GCENCRS"];

/** Texts by their number, each once. */
class Shared {
  readonly texts: string[] = [];
  readonly #numbers = new Map<string, number>();

  number(text: string): number {
    const known = this.#numbers.get(text);
    if (known !== undefined) return known;
    this.#numbers.set(text, this.texts.length);
    return this.texts.push(text) - 1;
  }
}

/**
 * Packs the horizontal and compound systems of a table; vertical ones have a table of their own.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function packEpsg(rows: readonly Row[]): PackedEpsg {
  requireKind(rows, "list", "packEpsg: rows");
  const [bases, methods] = [new Shared(), new Shared()];
  const geodetic: PackedEpsg["geodetic"][number][] = [];
  const projected: PackedEpsg["projected"][number][] = [];
  const compound: PackedEpsg["compound"][number][] = [];
  const strings: PackedEpsg["strings"][number][] = [];
  const shifts: PackedEpsg["shifts"][number][] = [];
  for (const { code: given, name, kind, wkt, proj4 } of rows) {
    const code = Number(given);
    if (!(code > 0 && code <= GREATEST)) continue;
    const node = wkt ? parseWkt(wkt)[0] : undefined;
    if (!node) {
      if (proj4) strings.push([kind, code, name, proj4]);
      continue;
    }
    const shift = translation(proj4 ? shiftOfProjString(proj4) : undefined);
    if (shift?.some((metres) => metres !== 0)) shifts.push([code, ...shift]);
    if (GEODETIC.includes(kind)) geodetic.push([kind, code, name, bases.number(baseText(node))]);
    else if (kind === "CRS-PROJCRS") {
      const base = child(node, "GEOGCS");
      if (!base) continue;
      const numbers = children(node, "PARAMETER").map((parameter) => number(parameter, 2));
      const shared = [bases.number(baseText(base)), methods.number(methodText(node))] as const;
      projected.push([code, name, epsgCode(base) ?? 0, ...shared, ...numbers]);
    } else if (kind === "CRS-COMPOUNDCRS") {
      const [horizontal, vertical] = children(node).map(epsgCode);
      if (horizontal !== undefined && vertical !== undefined) {
        compound.push([code, name, horizontal, vertical]);
      }
    }
  }
  return { bases: bases.texts, methods: methods.texts, geodetic, projected, compound, strings, shifts };
}

/** What a geographic or geocentric system says besides its name. Shifts other than translations are never believed. */
function baseText(node: WktNode): string {
  const parts = children(node, "DATUM", "PRIMEM", "UNIT", "AXIS").map((part) => {
    if (part[0] !== "DATUM") return written(part);
    const shift = child(part, "TOWGS84")?.slice(1).map(Number);
    const code = epsgCode(part);
    const kept = [
      ...children(part, "SPHEROID").map(
        (figure): WktNode => ["SPHEROID", "", number(figure, 2), number(figure, 3)],
      ),
      ...(shift && translation(shift) ? [["TOWGS84", ...shift] as WktNode] : []),
      ...(code === undefined ? [] : [["AUTHORITY", "EPSG", code] as WktNode]),
      ...children(part, "EXTENSION"),
    ];
    return written(["DATUM", text(part, 1), ...kept]);
  });
  return parts.join();
}

function methodText(node: WktNode): string {
  const parts = children(node, "PROJECTION", "PARAMETER", "UNIT", "AXIS", "EXTENSION").map((part) =>
    part[0] === "PARAMETER" ? `PARAMETER["${text(part, 1)}",#]` : written(part),
  );
  return parts.join();
}

/** A node without codes, which the reader takes from where they differ. */
function written([keyword, ...content]: WktNode): string {
  const items = content
    .filter((item) => !(isNode(item) && item[0] === "AUTHORITY" && keyword !== "DATUM"))
    .map((item: WktItem) => {
      if (isNode(item)) return written(item);
      return typeof item === "number" ? String(item) : `"${item.replaceAll('"', "'")}"`;
    });
  return `${keyword}[${items.join()}]`;
}

/**
 * A table for `resolveCrs` made of a packed one.
 *
 * @param verticals table of the vertical systems
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function epsgLookup(packed: PackedEpsg, verticals: EpsgLookup): EpsgLookup {
  requireFields(
    packed,
    {
      bases: "list",
      methods: "list",
      geodetic: "list",
      projected: "list",
      compound: "list",
      strings: "list",
      shifts: "list",
    },
    "epsgLookup: packed",
  );
  const { bases, methods } = packed;
  const shifts = new Map(packed.shifts.map(([code, ...shift]) => [code, shift]));
  const geodetic = new Map(packed.geodetic.map((row) => [row[1], row]));
  const projected = new Map(packed.projected.map((row) => [row[0], row]));
  const compound = new Map(packed.compound.map((row) => [row[0], row]));
  const strings = new Map(packed.strings.map((row) => [row[1], row]));
  const quoted = (name: string) => `"${name.replaceAll('"', "'")}"`;
  const shifted = (code: number) => {
    const shift = shifts.get(code);
    return shift && { proj4: `+towgs84=${shift.join()}` };
  };
  const lookup: EpsgLookup = (code) => {
    const own = geodetic.get(code);
    if (own) {
      const [kind, , name, base] = own;
      const keyword = kind === "CRS-GCENCRS" ? "GEOCCS" : "GEOGCS";
      const wkt = `${keyword}[${quoted(name)},${bases[base]},AUTHORITY["EPSG",${code}]]`;
      return { name, kind, wkt, ...shifted(code) };
    }
    const plane = projected.get(code);
    if (plane) {
      const [, name, geographic, base, method, ...numbers] = plane;
      const id = geographic === 0 ? "" : `,AUTHORITY["EPSG",${geographic}]`;
      let next = 0;
      const content = methods[method].replace(/#/g, () => String(numbers[next++]));
      const wkt = `PROJCS[${quoted(name)},GEOGCS["",${bases[base]}${id}],${content},AUTHORITY["EPSG",${code}]]`;
      return { name, kind: "CRS-PROJCRS", wkt, ...shifted(code) };
    }
    const text = strings.get(code);
    if (text) return { kind: text[0], name: text[2], proj4: text[3] };
    const joined = compound.get(code);
    if (!joined) return verticals(code);
    const [, name, horizontal, vertical] = joined;
    const parts = [horizontal, vertical].map((part) => lookup(part)?.wkt);
    if (parts.includes(undefined)) return undefined;
    const wkt = `COMPD_CS[${quoted(name)},${parts.join()},AUTHORITY["EPSG",${code}]]`;
    return { name, kind: "CRS-COMPOUNDCRS", wkt };
  };
  return lookup;
}
