import { basename, extname } from "node:path";
import { type StationEquation, StationEquations, type StationOptions, stations } from "@groma/layer/tools";
import type { CutRequest } from "../cut/cut.js";
import { readGivenLine } from "../cut/line-file.js";
import { type NarrowingOptions, narrowing } from "../cut/narrowing.js";
import type { GivenCrs } from "../cut/place.js";
import { type LaidLine, layLine } from "../cut/profile-line.js";
import { crossSections } from "../cut/volumes.js";
import type { CutOptions, WrittenStations } from "../cut/writers.js";
import type { ProgressKind } from "../given/choices.js";
import { tellCut } from "./cut.js";

export interface ProfileCommandOptions extends CutOptions, StationOptions, NarrowingOptions {
  /** File with the line: GeoJSON, DXF or LandXML. */
  readonly line: string;
  /** Layer of the polyline, or name of the alignment. */
  readonly lineName?: string;
  /** Default: longitude and latitude for GeoJSON, those of the scan for the others. */
  readonly lineCrs?: GivenCrs;
  /** In which plane points are decided. */
  readonly plane: "source" | "ellipsoid";
  /** Of the whole strip: source units, or metres where the line is in longitude and latitude. */
  readonly width: number;
  /** How chainage is counted: in the plane, or along geodesics; source units. */
  readonly stations: "grid" | "geodesic";
  /** Chainage at the start of the line. Default: what its file says, else 0. */
  readonly start?: number;
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
  const { line: file, lineCrs, lineName, width, sections, thickness, spacing } = options;
  const { left = width / 2, right = width / 2, interval, at } = options;
  const line = await readGivenLine(file, lineName);
  const choices = {
    ...{ line, width, crs: lineCrs ?? line.usualCrs, given: file },
    ...{ start: options.start, stations: options.stations, plane: options.plane },
  };
  const narrow = await narrowing(options);
  let laid: LaidLine | undefined;
  const select: CutRequest["select"] = async (origin, all) => {
    laid = await layLine(origin, all, choices);
    const { strip, unit, ellipsoid } = laid;
    const along = ellipsoid?.corridor(strip) ?? strip;
    if (!sections) return narrow({ origin, volume: along, along, spacing });
    const widths = { left: left * unit, right: right * unit, thickness: thickness * unit };
    const volume = crossSections(strip, (from, to) => stations(from, to, { interval, at }), widths);
    const parts = ellipsoid?.sections(volume) ?? volume;
    return narrow({ origin, volume: parts, line: along, spacing });
  };
  const request: CutRequest = {
    title: basename(file, extname(file)),
    given: [file, options.clips],
    ...(sections && { sections }),
    select,
    facts: (known) => laid?.ellipsoid?.facts(known) ?? known,
    stationing: () => stationingOf(laid?.equations ?? []),
  };
  await tellCut("profile", files, options, request);
}

/** What documents say of stations that are counted anew; nothing where none are. */
function stationingOf(equations: readonly StationEquation[]): WrittenStations {
  if (equations.length === 0) return {};
  const stationing = new StationEquations(equations);
  return { equations, stationOf: (chainage) => stationing.stationOf(chainage).station };
}
