import {
  type AreaOfUse,
  areaOf,
  countriesIn,
  extentOf,
  isInside,
  type Place,
  widthOf,
} from "../crs/area-of-use.js";
import type { EpsgEntry, EpsgLookup } from "../crs/crs.js";
import { child, epsgCode, isNode, number, parseWkt, text } from "../crs/tree.js";
import { VERTICAL } from "../crs/wkt-vertical.js";
import { requireFields, requireKind } from "../errors/arguments.js";

/** A vertical coordinate system of EPSG, without its geometry: what a page needs to take a reader at his word. */
export interface VerticalSystem {
  readonly code: number;
  readonly name: string;
  readonly unit: { readonly name: string; readonly size: number };
  /** Depths count downwards. */
  readonly depth: boolean;
  /** Where it is meant for. */
  readonly area: AreaOfUse;
  /** The countries that this is in; the area alone is a rectangle around them, with neighbours in its corners. */
  readonly countries: readonly string[];
  /** Horizontal systems that EPSG joins it with in a compound one. */
  readonly partners: readonly number[];
}

/** A row of an EPSG table. */
export interface EpsgRow extends EpsgEntry {
  readonly code: number | string;
}

/**
 * The vertical systems of an EPSG table, rising by code.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function verticalSystems(rows: readonly EpsgRow[]): VerticalSystem[] {
  requireKind(rows, "list", "verticalSystems: rows");
  const partners = partnersIn(rows);
  const systems = rows.flatMap((row): VerticalSystem[] => {
    const { code, kind, name, wkt } = row;
    const node = kind === "CRS-VERTCRS" && wkt ? parseWkt(wkt)[0] : undefined;
    const unit = node && child(node, "UNIT");
    const axis = node && child(node, "AXIS");
    if (!node || !unit || !VERTICAL.includes(node[0])) return [];
    return [
      {
        code: Number(code),
        name,
        unit: { name: text(unit, 1), size: number(unit, 2) },
        depth: axis !== undefined && text(axis, 2).toLowerCase() === "down",
        area: areaOf(row) ?? [-180, -90, 180, 90],
        countries: countriesIn(row.area ?? ""),
        partners: [...(partners.get(Number(code)) ?? [])].sort((a, b) => a - b),
      },
    ];
  });
  return systems.sort((a, b) => a.code - b.code);
}

function partnersIn(rows: readonly EpsgRow[]): Map<number, Set<number>> {
  const partners = new Map<number, Set<number>>();
  for (const { kind, wkt } of rows) {
    const [, , horizontal, vertical] = kind === "CRS-COMPOUNDCRS" && wkt ? parseWkt(wkt)[0] : [];
    if (!isNode(horizontal) || !isNode(vertical)) continue;
    const [first, second] = [epsgCode(horizontal), epsgCode(vertical)];
    if (first === undefined || second === undefined) continue;
    partners.set(second, (partners.get(second) ?? new Set()).add(first));
  }
  return partners;
}

/**
 * A table for {@link resolveCrs} that knows these systems and nothing else.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function verticalLookup(systems: readonly VerticalSystem[]): EpsgLookup {
  requireKind(systems, "list", "verticalLookup: systems");
  const byCode = new Map(systems.map((system) => [system.code, system]));
  return (code) => {
    const system = byCode.get(code);
    if (!system) return undefined;
    const { name, unit, depth } = system;
    const quoted = name.replaceAll('"', "'");
    const parts = [
      `VERT_DATUM["${quoted}",2005]`,
      `UNIT["${unit.name}",${unit.size}]`,
      `AXIS["Height",${depth ? "DOWN" : "UP"}]`,
      `AUTHORITY["EPSG","${code}"]`,
    ];
    return { name, kind: "CRS-VERTCRS", wkt: `VERT_CS["${quoted}",${parts.join(",")}]` };
  };
}

/** Where a data set is and what is known of its coordinates. */
export interface HeightClues extends Place {
  /** EPSG code of its horizontal system, where it has one. */
  readonly horizontal?: number | undefined;
  /** Countries that its horizontal system is meant for, where that is known. */
  readonly countries?: readonly string[] | undefined;
  /** Metres per unit of z. */
  readonly unit: number;
}

/** Systems that are meant for more of the earth than a continent say nothing of a place. */
const WORLD = 170;
/** Relative difference of two units that a reader may take for one another, such as the two feet. */
const SAME_UNIT = 1e-4;
const MOST = 5;
/** More countries than these share a system that says nothing of the country, such as a zone of UTM. */
const FEW_COUNTRIES = 3;
/**
 * Systems of one railway or tunnel, which EPSG lists for the whole country: HS2, the German railways (twice), the
 * Fehmarnbelt tunnel.
 */
const SPECIAL: ReadonlySet<number> = new Set([9303, 9923, 9927, 5597]);

/**
 * Height systems that a data set of unknown heights may be in, the likeliest first: of those in use at the place and
 * in the unit of z, the ones that EPSG joins with the data set's horizontal system; then those for a small area that the
 * place does not lie at the edge of, and those that EPSG joins with many systems, which are the national ones of today,
 * one doubling against the other. Where the horizontal system is meant for few countries, those of others are left out.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function likelySystems(systems: readonly VerticalSystem[], clues: HeightClues): VerticalSystem[] {
  requireKind(systems, "list", "likelySystems: systems");
  requireFields(clues, { longitude: "number", latitude: "number" }, "likelySystems: clues");
  const { horizontal, unit: wanted, countries = [] } = clues;
  const national = countries.length > 0 && countries.length <= FEW_COUNTRIES;
  const rank = ({ partners, unit, area }: VerticalSystem) => [
    horizontal !== undefined && partners.includes(horizontal) ? 0 : 1,
    Math.abs(unit.size / wanted - 1) < 1e-9 ? 0 : 1,
    extentOf(area) / (1 + partners.length) / depthIn(area, clues),
  ];
  return systems
    .filter(({ code, depth, area, unit, name, countries: own }) => {
      const fits = Math.abs(unit.size / wanted - 1) < SAME_UNIT;
      const meant = !depth && !SPECIAL.has(code) && !/example/i.test(name) && area[3] - area[1] < WORLD;
      const abroad = national && own.length > 0 && !own.some((country) => countries.includes(country));
      return meant && fits && !abroad && isInside(area, clues);
    })
    .map((system) => ({ system, rank: rank(system) }))
    .sort((a, b) => {
      const first = a.rank.findIndex((value, i) => value !== b.rank[i]);
      return first < 0 ? a.system.code - b.system.code : a.rank[first] - b.rank[first];
    })
    .slice(0, MOST)
    .map(({ system }) => system);
}

/**
 * How deep a place lies in an area: 1 from a quarter of its extent on, towards 0 at its edges, where a country's
 * rectangle covers its neighbours.
 */
function depthIn(area: AreaOfUse, { longitude, latitude }: Place): number {
  const east = (((longitude - area[0]) % 360) + 360) % 360;
  const shares = [east / widthOf(area), (latitude - area[1]) / (area[3] - area[1])];
  const least = Math.min(...shares.flatMap((share) => [share, 1 - share]));
  return Math.sqrt(Math.min(1, Math.max(0.001, 4 * least)));
}
