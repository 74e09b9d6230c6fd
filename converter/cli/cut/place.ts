import { type Crs, ecefToGeodetic, GromaError, pointTransform, samePlane } from "@groma/georef";
import type { CutFacts, PointSelection } from "@groma/layer/export";
import type { RecordedPoints } from "@groma/layer/query";
import { geodesicLengths, sourceLine } from "@groma/layer/tools";
import { OptionError } from "../given/option-error.js";
import { declarationOf } from "../place/declaration.js";
import { placed } from "../place/placed.js";
import type { Position } from "./geojson.js";

const DEGREE = Math.PI / 180;

/** In which coordinates a line or a polygon is given: those of the file, or longitude and latitude. */
export type GivenCrs = "source" | "EPSG:4326";

/** Places that were given, in the coordinates of a file, and the length of a unit that goes with them. */
export interface InSource {
  readonly positions: readonly (readonly [number, number])[];
  /** Source units for a unit of lengths that were given with the places: metres with longitude and latitude. */
  readonly unit: number;
}

/**
 * Brings places into the plane of a file's coordinates.
 *
 * @throws OptionError OPTION_CRS where they are no longitude and latitude, or the file's coordinates are angles
 * @throws CrsError, RecordError, PlacementError
 */
export async function inSource(
  positions: readonly Position[],
  crs: GivenCrs,
  { source }: RecordedPoints,
  given: string,
): Promise<InSource> {
  if (crs === "source") return { positions, unit: 1 };
  if (positions.some(([longitude, latitude]) => Math.abs(longitude) > 540 || Math.abs(latitude) > 90)) {
    throw new OptionError({
      ...{ code: "OPTION_CRS", file: given, cause: "its coordinates are no longitudes and latitudes" },
      fix: "give --line-crs source or --polygon-crs source for the coordinates of the scan",
    });
  }
  const { crs: named, truth } = await placed(declarationOf(source));
  if (named.horizontalUnit.kind === "angular") {
    throw new OptionError({
      ...{
        code: "OPTION_CRS",
        file: source.name,
        cause: "its coordinates are angles, in which no width is the same everywhere",
      },
      fix: "convert the scan to a projected system first",
    });
  }
  const transform = pointTransform(truth);
  const space = {
    boundingBox: source.boundingBox,
    place: (x: number, y: number, z: number, out: Float64Array) => {
      transform(x, y, z, out, 0);
      return out;
    },
  };
  const radians = positions.map(([longitude, latitude]) => [longitude * DEGREE, latitude * DEGREE] as const);
  return { positions: sourceLine(space, radians, given), unit: 1 / named.horizontalUnit.size };
}

/** The coordinate system of a file; undefined where it tells none. */
export async function systemOf({ source }: RecordedPoints): Promise<Crs | undefined> {
  try {
    return (await placed(declarationOf(source))).crs;
  } catch (error) {
    if (error instanceof GromaError) return undefined;
    throw error;
  }
}

/** Metres in a unit of a file's plane; undefined where that is not known, or no length. */
export async function unitOf(origin: RecordedPoints): Promise<number | undefined> {
  const unit = (await systemOf(origin))?.horizontalUnit;
  return unit?.kind === "linear" ? unit.size : undefined;
}

/** What planes files have. */
export interface Planes {
  /** Whether the coordinates of one of them are angles. */
  readonly angles: boolean;
  /** Whether they are not all the same. */
  readonly different: boolean;
}

/** @throws CrsError, RecordError */
export async function planesOf(opened: readonly RecordedPoints[]): Promise<Planes> {
  const systems: Crs[] = [];
  for (const { source } of opened) systems.push((await placed(declarationOf(source))).crs);
  return {
    angles: systems.some(({ horizontalUnit }) => horizontalUnit.kind === "angular"),
    different: systems.some((system) => !samePlane(systems[0]!, system)),
  };
}

/**
 * Refuses places in the files' own coordinates where these are of several systems, as far as the files tell them.
 * @param given file or option with the places, for errors
 * @throws OptionError OPTION_CRS
 */
export async function requireCommonPlane(opened: readonly RecordedPoints[], given: string): Promise<void> {
  const systems = (await Promise.all(opened.map(systemOf))).filter((system) => system !== undefined);
  if (systems.every((system) => samePlane(systems[0]!, system))) return;
  throw new OptionError({
    ...{ code: "OPTION_CRS", file: given, cause: "files of several systems have no coordinates in common" },
    fix: "give a polygon in longitude and latitude, or cut each file by itself",
  });
}

/**
 * A file's points on the globe, as volumes that stand there are held against them.
 * @throws CrsError, RecordError
 */
export async function spaceOf(origin: RecordedPoints) {
  const { source } = origin;
  const transform = pointTransform((await placed(declarationOf(source))).truth);
  return {
    boundingBox: source.boundingBox,
    place: (x: number, y: number, z: number, out: Float64Array) => {
      transform(x, y, z, out, 0);
      return out;
    },
    geodetic: await geodeticOf(origin),
  };
}

/**
 * Where source coordinates of a file are: longitude and latitude in radians, height above the ellipsoid in metres.
 * @throws CrsError, RecordError
 */
export async function radiansOf({
  source,
}: RecordedPoints): Promise<NonNullable<PointSelection["geodetic"]>> {
  const transform = pointTransform((await placed(declarationOf(source))).truth);
  const ecef = new Float64Array(3);
  return (x, y, z, out) => {
    transform(x, y, z, ecef, 0);
    ecefToGeodetic(ecef[0]!, ecef[1]!, ecef[2]!, out);
  };
}

/**
 * Where source coordinates of a file are: longitude and latitude in degrees, height above the ellipsoid in metres.
 * @throws CrsError, RecordError
 */
export async function geodeticOf(origin: RecordedPoints): Promise<NonNullable<PointSelection["geodetic"]>> {
  const radians = await radiansOf(origin);
  return (x, y, z, out) => {
    radians(x, y, z, out);
    out[0]! /= DEGREE;
    out[1]! /= DEGREE;
  };
}

/**
 * Lengths of the geodesics between places, metres.
 * @param positions as they were given
 * @throws CrsError, RecordError
 */
export async function lengthsOnEarth(
  positions: readonly Position[],
  crs: GivenCrs,
  origin: RecordedPoints,
): Promise<number[]> {
  const geodetic = crs === "source" ? await geodeticOf(origin) : undefined;
  const { min, max } = origin.source.boundingBox;
  const out = new Float64Array(3);
  const line = positions.map(([x, y]) => {
    out.set([x, y]);
    geodetic?.(x, y, (min[2] + max[2]) / 2, out);
    return [out[0]! * DEGREE, out[1]! * DEGREE] as const;
  });
  return geodesicLengths(line);
}

/** What documents say of a file's coordinates; where the file does not tell its system, nothing but the title. */
export async function factsOf(origin: RecordedPoints, title: string): Promise<CutFacts> {
  const { cutFacts } = await import("@groma/layer/export");
  return cutFacts(title, await systemOf(origin));
}
