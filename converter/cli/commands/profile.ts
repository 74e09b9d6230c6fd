import { basename, extname } from "node:path";
import { type StationOptions, stations } from "@groma/layer/tools";
import type { CutRequest } from "../cut/cut.js";
import { readLine } from "../cut/geojson.js";
import { type GivenCrs, inSource, lengthsOnEarth } from "../cut/place.js";
import { corridor, crossSections } from "../cut/volumes.js";
import type { CutOptions } from "../cut/writers.js";
import type { ProgressKind } from "../given/choices.js";
import { tellCut } from "./cut.js";

export interface ProfileCommandOptions extends CutOptions, StationOptions {
  /** GeoJSON file with the line. */
  readonly line: string;
  readonly lineCrs: GivenCrs;
  /** Of the whole strip: source units, or metres where the line is in longitude and latitude. */
  readonly width: number;
  /** How chainage is counted: in the plane, source units, or along geodesics, metres. */
  readonly stations: "grid" | "geodesic";
  /** Chainage at the start of the line, in the same unit. */
  readonly start: number;
  /** Cuts across the line, at an interval and at stations, instead of along it. */
  readonly sections?: true;
  /** How far sections reach. Default: half the width. In the unit of the width. */
  readonly left?: number;
  readonly right?: number;
  /** Of sections, in the unit of the width. */
  readonly thickness: number;
  /** Distance between points that suffices, source units. Default: every point. */
  readonly spacing?: number;
  readonly progress?: ProgressKind;
}

/** The `profile` command: all points in a strip along a line, or in cross-sections of it. */
export async function runProfile(files: readonly string[], options: ProfileCommandOptions): Promise<void> {
  const { line: file, lineCrs, width, start, sections, thickness, spacing } = options;
  const { left = width / 2, right = width / 2, interval, at } = options;
  const line = await readLine(file);
  const select: CutRequest["select"] = async (origin) => {
    const lengths = options.stations === "geodesic" ? await lengthsOnEarth(line, lineCrs, origin) : undefined;
    const inPlane = await inSource(line, lineCrs, origin, file);
    const strip = corridor(inPlane, width, { lengths, start }, file);
    if (!sections) return { origin, volume: strip, along: strip, spacing };
    const { unit } = inPlane;
    const widths = { left: left * unit, right: right * unit, thickness: thickness * unit };
    const volume = crossSections(strip, (from, to) => stations(from, to, { interval, at }), widths);
    return { origin, volume, line: strip, spacing };
  };
  await tellCut("profile", files, options, {
    title: basename(file, extname(file)),
    ...(sections && { sections }),
    select,
  });
}
