import { readLine } from "../cut/geojson.js";
import { type GivenCrs, inSource, lengthsOnEarth } from "../cut/place.js";
import { corridor } from "../cut/volumes.js";
import type { CutOptions } from "../cut/writers.js";
import type { ProgressKind } from "../given/choices.js";
import { tellCut } from "./cut.js";

export interface ProfileCommandOptions extends CutOptions {
  /** GeoJSON file with the line. */
  readonly line: string;
  readonly lineCrs: GivenCrs;
  /** Of the whole strip: source units, or metres where the line is in longitude and latitude. */
  readonly width: number;
  /** How chainage is counted: in the plane, source units, or along geodesics, metres. */
  readonly stations: "grid" | "geodesic";
  /** Chainage at the start of the line, in the same unit. */
  readonly start: number;
  readonly progress?: ProgressKind;
}

/** The `profile` command: all points in a strip along a line, as one file. */
export async function runProfile(files: readonly string[], options: ProfileCommandOptions): Promise<void> {
  const { line: file, lineCrs, width, start } = options;
  const line = await readLine(file);
  await tellCut("profile", files, options, async (origin) => {
    const lengths = options.stations === "geodesic" ? await lengthsOnEarth(line, lineCrs, origin) : undefined;
    const inPlane = await inSource(line, lineCrs, origin, file);
    const strip = corridor(inPlane, width, { lengths, start }, file);
    return { origin, volume: strip, along: strip };
  });
}
