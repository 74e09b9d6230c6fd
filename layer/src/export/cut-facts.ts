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
