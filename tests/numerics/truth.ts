import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { type Crs, type EpsgLookup, type ExactTransform, exactTransform } from "@groma/georef";
import { data } from "../project.js";

/** A truth table as it stands, and why the tests that need it are skipped if it is not there. */
export function truth<T>(name: string): { rows: T[]; missing: string | undefined } {
  const { path, missing } = data(`truth/${name}`);
  return { rows: missing === undefined ? (JSON.parse(readFileSync(path, "utf8")) as T[]) : [], missing };
}

/** The table of EPSG codes that the command line brings along. */
const epsgTable = createRequire(import.meta.url)("epsg-index/all.json") as Record<
  string,
  ReturnType<EpsgLookup>
>;

export const lookup: EpsgLookup = (code) => epsgTable[code];

/** The exact transform of a CRS with its datum shift left out, on its own ellipsoid: what truth in the source datum is held against. */
export function withoutShift(crs: Crs): ExactTransform {
  const proj4 = crs.proj4.replace(/ ?\+towgs84=\S+/, "");
  const sphere = proj4.includes("+nadgrids=@null");
  const height = { kind: "ellipsoidal" } as const;
  return exactTransform({ ...crs, height, proj4: sphere ? proj4 : `${proj4} +towgs84=0,0,0` });
}

export const radians = (degrees: number): number => (degrees * Math.PI) / 180;

/** Length of the difference of two triples, metres for ECEF. */
export function distance(a: ArrayLike<number>, b: ArrayLike<number>): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/** A reproducible generator of numbers from 0 to 1 (mulberry32). */
export function random(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}
