import {
  type AreaOfUse,
  areaOf,
  areOverlapping,
  type Crs,
  CrsError,
  type EpsgLookup,
  type EpsgRow,
  ecefToGeodetic,
  extentOf,
  isInside,
  type Place,
  pointTransform,
  resolveCrs,
  truthOf,
} from "@groma/georef";

const DEGREE = Math.PI / 180;
/** The greatest code that EPSG gives out itself; the table has those of ESRI's software too. */
const EPSG_MAX = 32767;
/** Square degrees: a system that is meant for more than a zone of UTM fits too many numbers to say anything. */
const ZONE = 600;
const MOST = 3;

/** A coordinate reference system that numbers may be in, and where they would lie. */
export interface LikelyCrs extends Place {
  readonly code: number;
  readonly name: string;
}

/**
 * The projected systems whose area of use would hold a point when its coordinates are read in them, and overlaps a region:
 * in which a file lies although its own system says otherwise. Those with the right unit come first, then those that
 * EPSG joins with a height system, which are in use for surveys, then those for small areas. Numbers fit many systems:
 * this is a hint and nothing to go by. A second or two.
 *
 * @param x source units, as `y`
 * @param unit metres per unit, as the file has it
 */
export function likelyCrs(
  rows: readonly EpsgRow[],
  [x, y]: readonly [number, number],
  region: AreaOfUse,
  unit: number,
): LikelyCrs[] {
  const table = new Map(rows.map((row) => [Number(row.code), row]));
  const joined = joinedWithHeights(rows);
  const found = rows.flatMap((row) => {
    const area = areaOf(row);
    const code = Number(row.code);
    if (row.kind !== "CRS-PROJCRS" || code > EPSG_MAX || !area) return [];
    if (extentOf(area) > ZONE || !areOverlapping(area, region)) return [];
    const read = placeIn(code, x, y, (asked) => table.get(asked));
    if (!read || !isInside(area, read.place)) return [];
    const rank = [
      Math.abs(read.crs.horizontalUnit.size / unit - 1) < 1e-4 ? 0 : 1,
      joined.has(row.name) ? 0 : 1,
      extentOf(area),
      code,
    ];
    return [{ code, name: row.name, ...read.place, rank }];
  });
  return found
    .sort((a, b) => a.rank.map((value, i) => value - b.rank[i]!).find((difference) => difference !== 0) ?? 0)
    .slice(0, MOST)
    .map(({ rank: _, ...likely }) => likely);
}

/** Names of the horizontal parts of compound systems. */
function joinedWithHeights(rows: readonly EpsgRow[]): Set<string> {
  const parts = rows.map(({ kind, wkt }) => {
    return kind === "CRS-COMPOUNDCRS"
      ? /^COMPD_CS\["[^"]*",PROJCS\["([^"]*)"/.exec(wkt ?? "")?.[1]
      : undefined;
  });
  return new Set(parts.filter((name) => name !== undefined));
}

function placeIn(
  code: number,
  x: number,
  y: number,
  lookup: EpsgLookup,
): { crs: Crs; place: Place } | undefined {
  try {
    const crs = resolveCrs({ file: `EPSG:${code}`, given: `EPSG:${code}` }, lookup);
    const ecef = new Float64Array(3);
    pointTransform(truthOf({ crs }, 0, crs.name))(x, y, 0, ecef, 0);
    if (!ecef.every(Number.isFinite)) return undefined;
    const geodetic = new Float64Array(3);
    ecefToGeodetic(ecef[0]!, ecef[1]!, ecef[2]!, geodetic);
    return { crs, place: { longitude: geodetic[0]! / DEGREE, latitude: geodetic[1]! / DEGREE } };
  } catch (error) {
    // A system that cannot be used is nothing to suggest.
    if (error instanceof CrsError) return undefined;
    throw error;
  }
}
