import {
  CrsError,
  ecefToGeodetic,
  geodeticToEcef,
  isOwnPlane,
  placePoint,
  resolveCrs,
  type Truth,
  truthOnMap,
  WGS84,
} from "@groma/georef";
import type { Scan } from "../core/core.js";
import { OptionError } from "../given/option-error.js";
import type { Row } from "../given/rows.js";
import { epsg } from "./epsg.js";
import type { Placed } from "./placed.js";

const DEGREE = Math.PI / 180;

/** Places that the coordinates of a scan are wanted of, and the map of the scan that leads there. */
interface GivenPlaces {
  readonly truth: Truth;
  /** What {@link truth} leads to, metres: ECEF, or the plane of a map with the height above the ellipsoid. */
  readonly targets: readonly (readonly [number, number, number])[];
}

/**
 * Places as they were given.
 *
 * @param from `ecef`: X, Y, Z in metres; `geodetic`: longitude, latitude in degrees, height above the ellipsoid in metres;
 *   else a map projection (EPSG code, PROJ string, WKT): x, y in its units, height above the ellipsoid in metres, as a map in
 *   that projection has it by proj4js; where it is the scan's own, x and y are those of the scan
 * @throws OptionError OPTION_INVERSE where it is none of these
 */
export function givenPlaces(place: Placed, rows: readonly Row[], scan: Scan, from: string): GivenPlaces {
  const { truth } = place;
  const triples = rows.map(({ values: [x = 0, y = 0, z = 0] }) => [x, y, z] as const);
  if (from === "ecef") return { truth, targets: triples };
  if (from === "geodetic") return { truth, targets: triples.map(inSpace) };
  const { plane, metresPerUnit } = planeOf(place, scan, from);
  const middle = (scan.min[2] + scan.max[2]) / 2;
  return {
    truth: truthOnMap(truth, plane, middle, place.crs.verticalUnit.size, scan.file),
    targets: triples.map(([x, y, z]) => [x * metresPerUnit, y * metresPerUnit, z]),
  };
}

function inSpace([longitude, latitude, height]: readonly [number, number, number]) {
  const ecef = new Float64Array(3);
  geodeticToEcef(longitude * DEGREE, latitude * DEGREE, height, ecef);
  return [ecef[0]!, ecef[1]!, ecef[2]!] as const;
}

function planeOf({ crs, truth, engine }: Placed, { min, max, file }: Scan, from: string) {
  const map = mapCrs(from);
  const { kind, size } = map.horizontalUnit;
  const metresPerUnit = kind === "angular" ? WGS84.a * size : size;
  const ecef = new Float64Array(3);
  const [x, y, z] = [0, 1, 2].map((axis) => (min[axis]! + max[axis]!) / 2) as [number, number, number];
  placePoint(truth, x, y, z, ecef, file);
  ecefToGeodetic(ecef[0]!, ecef[1]!, ecef[2]!, ecef);
  const common = {
    code: map.code ?? from,
    definition: map.proj4,
    metresPerUnit,
    wraps: false,
    middle: ecef[0]!,
  };
  const box = { minX: min[0], minY: min[1], maxX: max[0], maxY: max[1] };
  const own = engine.name !== "similarity" && isOwnPlane(crs, common, box);
  return { plane: { ...common, own }, metresPerUnit };
}

function mapCrs(from: string) {
  try {
    const crs = resolveCrs({ file: "--inverse", given: from }, epsg);
    if (!/\+proj=geocent\b/.test(crs.proj4)) return crs;
  } catch (error) {
    if (!(error instanceof CrsError)) throw error;
    throw noPlaces(`"${from}" is no projection that is known here: ${error.cause}`);
  }
  throw noPlaces("coordinates in space are given as ecef, in metres");
}

function noPlaces(cause: string): OptionError {
  return new OptionError({
    ...{ code: "OPTION_INVERSE", file: "--inverse", cause },
    fix: "give ecef, geodetic, or the code of a map projection such as EPSG:3857",
  });
}
