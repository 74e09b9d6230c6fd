import {
  areaOf,
  type Crs,
  CrsError,
  type CrsNote,
  countriesIn,
  distanceTo,
  type EpsgEntry,
  ecefToGeodetic,
  likelySystems,
  type Place,
  PlacementError,
  pointTransform,
  type Truth,
  truthOf,
} from "@groma/georef";
import type { PointBounds } from "../core/core.js";
import { length } from "../terminal/output.js";
import { epsg, epsgRows, heightSystems } from "./epsg.js";
import { likelyCrs } from "./likely-crs.js";
import type { LocalPlace } from "./local.js";

const DEGREE = Math.PI / 180;
/** Metres outside of its area from which a system is taken for a mistake: neighbours of a zone often use it. */
const NEIGHBOURHOOD = 300_000;
/** Metres from its anchor at which a rigid body departs from the ground by 8 m, and is no scan of one place any more. */
const ANCHOR_REACH = 10_000;
/** Metres above the ellipsoid between which scans are made, with room: the deepest trench is 11 km deep, and planes end far below 100. */
const HEIGHTS = [-12_000, 100_000] as const;
/** Letters of an area of use that a message shows. */
const SHOWN = 80;

/** Where the middle of a data set lies, and what is strange about that. */
export interface Whereabouts {
  /** Undefined where its middle has no place. */
  readonly centre: Place | undefined;
  readonly notes: readonly CrsNote[];
}

/**
 * Where the middle of a data set's bounds lies, and whether its systems are meant for that place.
 *
 * @param truth source coordinates → ECEF
 */
export function whereabouts(crs: Crs, truth: Truth, bounds: PointBounds): Whereabouts {
  const centre = centreOf(truth, bounds);
  if (!centre) return { centre, notes: [placelessNote(crs, bounds)] };
  const notes = areaNote(crs, centre, bounds) ?? heightNote(crs, centre) ?? [];
  return { centre, notes: [...notes, ...altitudeNote(crs, truth, bounds)] };
}

/** As {@link whereabouts} before an engine has placed anything: by proj4js, to some metres. */
export function expectedWhereabouts(
  { crs, local }: { readonly crs: Crs; readonly local?: Pick<LocalPlace, "similarity" | "at"> },
  bounds: PointBounds,
): Whereabouts {
  try {
    const truth = truthOf({ crs, similarity: local?.similarity }, middleOf(bounds)[2], crs.name);
    const found = whereabouts(crs, truth, bounds);
    return { ...found, notes: [...found.notes, ...anchorNote(crs, local?.at, bounds)] };
  } catch (error) {
    // Whoever converts says why; PROJ may know a way.
    if (error instanceof CrsError || error instanceof PlacementError) return { centre: undefined, notes: [] };
    throw error;
  }
}

/**
 * `ANCHOR_FAR`: a scan that lies far from the point of its coordinates that stands at the anchor: most often, coordinates
 * of a map whose origin was taken for that of the scan.
 */
function anchorNote({ horizontalUnit }: Crs, at: LocalPlace["at"], bounds: PointBounds): CrsNote[] {
  if (!at) return [];
  const far = horizontalUnit.size * Math.hypot(...middleOf(bounds).map((value, axis) => value - at[axis]!));
  if (far < ANCHOR_REACH) return [];
  const point = at.some((value) => value !== 0) ? `the point ${at.join(", ")}` : "the origin";
  const text = `the middle of the data set lies ${length(far)} from ${point} of its coordinates, which stands at the anchor; name the point of the scan that stands there with --anchor-at x,y,z`;
  return [{ code: "ANCHOR_FAR", text }];
}

/** `CRS_PLACELESS`: the projection ends before it reaches the data set. */
function placelessNote({ name }: Crs, bounds: PointBounds): CrsNote {
  const [x, y] = middleOf(bounds).map((value) => Number(value.toFixed(3)));
  const text = `the middle of the data set (x ${x}, y ${y}) has no place in ${name}; check that the scan was made in this system, or name the right one with --crs`;
  return { code: "CRS_PLACELESS", text };
}

/** `CRS_AREA`: how far outside of the area of use of its system the data set lies, and what its numbers would fit. */
function areaNote(crs: Crs, centre: Place, bounds: PointBounds): CrsNote[] | undefined {
  const code = planeCode(crs);
  const plane = code === undefined ? undefined : epsg(code);
  const far = distance(plane, centre);
  if (!plane || far === 0) return undefined;
  const system = heightSystem(crs);
  // A height system of a country says more of where a file belongs than the system that does not fit.
  const abroad = distance(system, centre);
  const region = areaOf(abroad > 0 ? system! : plane)!;
  const [x, y] = middleOf(bounds);
  const search = Math.max(far, abroad) > NEIGHBOURHOOD;
  const likely = search ? likelyCrs(epsgRows(), [x, y], region, crs.horizontalUnit.size) : [];
  const hint =
    likely.length === 0
      ? ""
      : `; the coordinates would fit ${named(likely)} (candidates; use --crs to apply one)`;
  const where = `the middle of the data set (${pointInWords(centre)}) lies ${length(far)} outside of the area of use`;
  return [{ code: "CRS_AREA", text: `${where} of EPSG:${code} (${shown(plane)})${hint}` }];
}

/** `CRS_AREA`: no scan lies so deep, or so high; plane coordinates in a geocentric system do, and z in a wrong unit. */
function altitudeNote({ name }: Crs, truth: Truth, bounds: PointBounds): CrsNote[] {
  const height = geodeticOf(truth, bounds)?.[2] ?? 0;
  if (height >= HEIGHTS[0] && height <= HEIGHTS[1]) return [];
  const where = `${length(Math.abs(height))} ${height < 0 ? "below" : "above"} the ellipsoid`;
  const text = `the middle of the data set lies ${where} in ${name}, where no scan is made; check the unit of z, and name the system of the scan with --crs`;
  return [{ code: "CRS_AREA", text }];
}

/** Name of the height system of a data set whose middle lies outside of its area of use; undefined within it. */
export function heightSystemAbroad(crs: Crs, truth: Truth, bounds: PointBounds): string | undefined {
  const system = heightSystem(crs);
  const centre = centreOf(truth, bounds);
  return system && centre && distance(system, centre) > 0 ? system.name : undefined;
}

/** `CRS_HEIGHT_AREA`: the same for its height system. */
function heightNote(crs: Crs, centre: Place): CrsNote[] | undefined {
  const system = heightSystem(crs);
  const far = distance(system, centre);
  if (!system || far === 0) return undefined;
  const horizontal = planeCode(crs);
  const countries = countriesOf(horizontal);
  const clues = { ...centre, unit: Math.abs(crs.verticalUnit.size), horizontal, countries };
  const likely = likelySystems(heightSystems(), clues);
  const hint = likely.length === 0 ? "" : `; in use there: ${named(likely)}`;
  const where = `the middle of the data set (${pointInWords(centre)}) lies ${length(far)} outside of the area of use`;
  const text = `${where} of the height system ${system.name} (${shown(system)})${hint}`;
  return [{ code: "CRS_HEIGHT_AREA", text }];
}

/** EPSG code of the horizontal part. */
function planeCode({ code }: Crs): number | undefined {
  const digits = /^EPSG:(\d+)/.exec(code ?? "")?.[1];
  return digits === undefined ? undefined : Number(digits);
}

function heightSystem({ height }: Crs): EpsgEntry | undefined {
  return height.kind === "geoid" && height.epsg !== undefined ? epsg(height.epsg) : undefined;
}

/** The countries that a horizontal system is meant for; none where it has no code. */
export function countriesOf(code: number | undefined): string[] {
  return countriesIn((code === undefined ? undefined : epsg(code)?.area) ?? "");
}

function named(systems: readonly { readonly code: number; readonly name: string }[]): string {
  return systems.map(({ code, name }) => `EPSG:${code} (${name})`).join(", ");
}

/** Metres from a place to the area of use of a system; 0 inside, and where no area is known. */
function distance(entry: EpsgEntry | undefined, place: Place): number {
  const area = entry && areaOf(entry);
  return area ? distanceTo(area, place) : 0;
}

/** The place of the middle of bounds; undefined where it has none. */
export function centreOf(truth: Truth, bounds: PointBounds): Place | undefined {
  const geodetic = geodeticOf(truth, bounds);
  return geodetic && { longitude: geodetic[0]! / DEGREE, latitude: geodetic[1]! / DEGREE };
}

/** Longitude, latitude (radians) and height (metres) of the middle of bounds; undefined where it has no place. */
function geodeticOf(truth: Truth, bounds: PointBounds): Float64Array | undefined {
  const [x, y, z] = middleOf(bounds);
  const ecef = new Float64Array(3);
  pointTransform(truth)(x, y, z, ecef, 0);
  if (!ecef.every(Number.isFinite)) return undefined;
  const geodetic = new Float64Array(3);
  ecefToGeodetic(ecef[0]!, ecef[1]!, ecef[2]!, geodetic);
  return geodetic;
}

function middleOf({ min, max }: PointBounds): [number, number, number] {
  return min.map((least, axis) => (least + max[axis]!) / 2) as [number, number, number];
}

/** `longitude 9.0014°, latitude 48.7539°`: ten metres, as far as a place without its height system is known. */
function pointInWords({ longitude, latitude }: Place): string {
  return `longitude ${longitude.toFixed(4)}°, latitude ${latitude.toFixed(4)}°`;
}

function shown({ area = "" }: EpsgEntry): string {
  const text = area.replace(/\.\s*$/, "");
  return text.length > SHOWN ? `${text.slice(0, SHOWN)}…` : text;
}

/** The row of an output for people that tells the centre, if there is one. */
export function centreRow({ centre }: Whereabouts): [label: string, text: string][] {
  return centre ? [["centre", pointInWords(centre)]] : [];
}
