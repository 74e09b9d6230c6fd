import type { EpsgEntry, EpsgLookup } from "../crs/crs.js";
import { child, epsgCode, isNode, number, parseWkt, text } from "../crs/tree.js";
import { VERTICAL } from "../crs/wkt-vertical.js";

/** A vertical coordinate system of EPSG, without its geometry: what a page needs to take a reader at his word. */
export interface VerticalSystem {
  readonly code: number;
  readonly name: string;
  readonly unit: { readonly name: string; readonly size: number };
  /** Depths count downwards. */
  readonly depth: boolean;
  /** Where it is meant for: west, south, east, north in degrees; `west` exceeds `east` across the antimeridian. */
  readonly area: readonly [number, number, number, number];
  /** Horizontal systems that EPSG joins it with in a compound one. */
  readonly partners: readonly number[];
}

/** A row of an EPSG table. */
export interface EpsgRow extends EpsgEntry {
  readonly code: number | string;
  /** North, west, south, east in degrees. */
  readonly bbox?: readonly number[] | undefined;
}

/** The vertical systems of an EPSG table, rising by code. */
export function verticalSystems(rows: readonly EpsgRow[]): VerticalSystem[] {
  const partners = partnersIn(rows);
  const systems = rows.flatMap(({ code, kind, name, wkt, bbox = [90, -180, -90, 180] }): VerticalSystem[] => {
    const node = kind === "CRS-VERTCRS" && wkt ? parseWkt(wkt)[0] : undefined;
    const unit = node && child(node, "UNIT");
    const axis = node && child(node, "AXIS");
    if (!node || !unit || !VERTICAL.includes(node[0])) return [];
    const [north, west, south, east] = bbox;
    return [
      {
        code: Number(code),
        name,
        unit: { name: text(unit, 1), size: number(unit, 2) },
        depth: axis !== undefined && text(axis, 2).toLowerCase() === "down",
        area: [west, south, east, north],
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

/** A table for {@link resolveCrs} that knows these systems and nothing else. */
export function verticalLookup(systems: readonly VerticalSystem[]): EpsgLookup {
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
export interface HeightClues {
  /** Degrees. */
  readonly longitude: number;
  readonly latitude: number;
  /** EPSG code of its horizontal system, where it has one. */
  readonly horizontal?: number | undefined;
  /** Metres per unit of z. */
  readonly unit: number;
}

/** Systems that are meant for more of the earth than a continent say nothing of a place. */
const WORLD = 170;
/** Relative difference of two units that a reader may take for one another, such as the two feet. */
const SAME_UNIT = 1e-4;
const MOST = 5;

/**
 * Height systems that a data set of unknown heights may be in, the likeliest first: of those in use at the place and
 * in the unit of z, the ones that EPSG joins with the data set's horizontal system; then those for a small area, and
 * those it joins with many systems, which are the national ones of today, one doubling against the other.
 */
export function likelySystems(systems: readonly VerticalSystem[], clues: HeightClues): VerticalSystem[] {
  const rank = ({ partners, unit, area }: VerticalSystem) => [
    clues.horizontal !== undefined && partners.includes(clues.horizontal) ? 0 : 1,
    Math.abs(unit.size / clues.unit - 1) < 1e-9 ? 0 : 1,
    extent(area) / (1 + partners.length),
  ];
  return systems
    .filter(({ depth, area, unit, name }) => {
      const fits = Math.abs(unit.size / clues.unit - 1) < SAME_UNIT;
      return !depth && fits && area[3] - area[1] < WORLD && !/example/i.test(name) && holds(area, clues);
    })
    .map((system) => ({ system, rank: rank(system) }))
    .sort((a, b) => {
      const first = a.rank.findIndex((value, i) => value !== b.rank[i]);
      return first < 0 ? a.system.code - b.system.code : a.rank[first] - b.rank[first];
    })
    .slice(0, MOST)
    .map(({ system }) => system);
}

function width([west, , east]: VerticalSystem["area"]): number {
  return east >= west ? east - west : east - west + 360;
}

function extent(area: VerticalSystem["area"]): number {
  return width(area) * (area[3] - area[1]);
}

function holds(area: VerticalSystem["area"], { longitude, latitude }: HeightClues): boolean {
  const east = (((longitude - area[0]) % 360) + 360) % 360;
  return latitude >= area[1] && latitude <= area[3] && east <= width(area);
}
