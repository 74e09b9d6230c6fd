import { readFileSync } from "node:fs";
import { type Crs, type ExactTransform, exactTransform } from "@groma/georef";
import { data } from "../project.js";

/** A truth table as it stands, and why the tests that need it are skipped if it is not there. */
export function truth<T>(name: string): { rows: T[]; missing: string | undefined } {
  const { path, missing } = data(`truth/${name}`);
  return { rows: missing === undefined ? (JSON.parse(readFileSync(path, "utf8")) as T[]) : [], missing };
}

/** The exact transform of a CRS with its datum shift left out, on its own ellipsoid: what truth in the source datum is held against. */
export function withoutShift(crs: Crs): ExactTransform {
  const proj4 = crs.proj4.replace(/ ?\+towgs84=\S+/, "");
  const sphere = proj4.includes("+nadgrids=@null");
  const height = { kind: "ellipsoidal" } as const;
  return exactTransform({ ...crs, height, proj4: sphere ? proj4 : `${proj4} +towgs84=0,0,0` });
}
