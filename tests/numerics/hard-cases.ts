import { distance, radians } from "../../georef/src/cartesian/points.fixture.js";
import { truth } from "./truth.js";

/** One row of `truth/hard_cases.json`. */
export interface HardCase {
  readonly name: string;
  readonly input: Readonly<Record<string, unknown>>;
  readonly truth: Readonly<Record<string, unknown>>;
  /** Metres, or what the family says. */
  readonly tolerance: number | Readonly<Record<string, number | null>>;
  readonly source: string;
}

const table = truth<HardCase>("hard_cases.json");

/** All cases, and why they are skipped if the table is not there. */
export const { rows, missing } = table;

/** By how their names begin; each case belongs to exactly one. */
export const FAMILIES = [
  "ECEF->geodetic",
  "TM exact",
  "LAEA",
  "reprojection",
  "unit trap",
  "EGM96",
  "geodesic inverse",
  "geodesic direct",
  "geodesic polygon",
  "planar shoelace",
  "slab",
  "covariance",
  "quantisation",
] as const;

export const of = (family: (typeof FAMILIES)[number]) => rows.filter(({ name }) => name.startsWith(family));

/** Rows as `it.each` takes them, `%s` the name. */
export const named = (list: readonly HardCase[]) => list.map((row) => [row.name, row] as const);

/** Title of a suite, with the reason if it is skipped. */
export const titled = (title: string) => `${title}${missing === undefined ? "" : ` (${missing})`}`;

/** One number of a tolerance. */
export function tolerance({ tolerance: given }: HardCase, part = "pos_m"): number {
  return typeof given === "number" ? given : Number(given[part]);
}

export const triple = (value: unknown) => value as readonly [number, number, number];
export const pairs = (value: unknown) => value as readonly (readonly [number, number])[];
export { distance, radians };
