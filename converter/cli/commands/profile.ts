import { basename, extname } from "node:path";
import type { PaintedSource } from "@groma/layer/export";
import { type StationEquation, StationEquations, type StationOptions, stations } from "@groma/layer/tools";
import type { CutRequest } from "../cut/cut.js";
import { readGivenLine } from "../cut/line-file.js";
import { type NarrowingOptions, narrowing } from "../cut/narrowing.js";
import type { GivenCrs } from "../cut/place.js";
import { type LaidLine, layLine } from "../cut/profile-line.js";
import { checkGround, crossSections } from "../cut/volumes.js";
import type { CutOptions, ShownOptions } from "../cut/writers.js";
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
  /** Attribute that pictures are coloured by, or `side`. Default: the scan's own colours. */
  readonly colorBy?: string;
  /** Its values at both ends of the gradient. */
  readonly colorRange?: readonly [number, number];
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
  let sources: readonly PaintedSource[] = [];
  const select: CutRequest["select"] = async (origin, all) => {
    laid = await layLine(origin, all, choices);
    sources = all.map((one) => one.source);
    const { strip, unit, ellipsoid } = laid;
    checkGround(strip, options.ground?.interval);
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
    shown: async () => {
      const paint = await paintOf(options, sources, sections ? undefined : laid?.strip.reach);
      return { ...stationsOf(laid?.equations ?? []), paint };
    },
  };
  await tellCut("profile", files, options, request);
}

/**
 * How pictures are coloured; undefined: as the scan's points are.
 * @param reach how far points lie from the line; of sections each has its own, by which none is coloured
 * @throws StyleError STYLE_COLOR, STYLE_NO_RGB, STYLE_RANGE
 */
async function paintOf(
  { colorBy, colorRange: range }: Pick<ProfileCommandOptions, "colorBy" | "colorRange">,
  [first, ...others]: readonly PaintedSource[],
  reach: number | undefined,
): Promise<ShownOptions["paint"]> {
  if (colorBy === undefined || !first) return undefined;
  const { OFFSET, paintBy } = await import("@groma/layer/export");
  return paintBy({ color: colorBy === "side" ? OFFSET : colorBy, range, reach }, [first, ...others]);
}

/** What documents say of stations that are counted anew; nothing where none are. */
function stationsOf(equations: readonly StationEquation[]): ShownOptions {
  if (equations.length === 0) return {};
  const stationing = new StationEquations(equations);
  return { equations, stationOf: (chainage) => stationing.stationOf(chainage).station };
}
