import type { Crs, Unit } from "@groma/georef";

/** A unit of length. */
export interface LengthUnit {
  /** As it is written behind numbers: `m`, `ft`, `US ft`, or `units` where nothing is known. */
  readonly text: string;
  /** Metres in it; 1 where nothing is known. */
  readonly size: number;
}

/** What is known of the coordinates of a cut, for documents about it. */
export interface CutFacts {
  /** Name of the profile. */
  readonly title: string;
  /** Name of the coordinate reference system; undefined where none is known. */
  readonly crs?: string | undefined;
  /** EPSG code of its plane. */
  readonly epsg?: number | undefined;
  /** What heights count from, in words: `NAP height`, `ellipsoidal`. */
  readonly heights?: string | undefined;
  /** Of x, y, chainage and offset. */
  readonly unit: LengthUnit;
  /** Of z. */
  readonly heightUnit: LengthUnit;
}

/** The line of words about the coordinates that documents bear. */
export function coordinatesInWords({ crs, heights }: CutFacts): string {
  return `${crs ?? "coordinate reference system unknown"}, heights ${heights ?? "unknown"}`;
}

/** How units are written behind numbers. */
const UNIT_TEXTS: ReadonlyMap<string, string> = new Map([
  ["metre", "m"],
  ["foot", "ft"],
  ["US survey foot", "US ft"],
]);

const UNKNOWN_UNIT: LengthUnit = { text: "units of the scan", size: 1 };

/**
 * What documents say of a coordinate reference system.
 * @param crs undefined where none is known: then units have no size either
 */
export function cutFacts(title: string, crs: Crs | undefined): CutFacts {
  if (!crs) return { title, unit: UNKNOWN_UNIT, heightUnit: UNKNOWN_UNIT };
  const { name, code, height, horizontalUnit, verticalUnit } = crs;
  const epsg = /^EPSG:(\d+)/.exec(code ?? "")?.[1];
  const geoid = height.kind === "geoid" ? height.model : undefined;
  return {
    ...{ title, crs: name, heights: height.kind === "ellipsoidal" ? "above the ellipsoid" : geoid },
    unit: horizontalUnit.kind === "linear" ? inWords(horizontalUnit) : { text: "degrees", size: 1 },
    heightUnit: inWords(verticalUnit),
    ...(epsg !== undefined && { epsg: Number(epsg) }),
  };
}

function inWords({ name, size }: Unit): LengthUnit {
  return { text: UNIT_TEXTS.get(name) ?? name, size: Math.abs(size) };
}
