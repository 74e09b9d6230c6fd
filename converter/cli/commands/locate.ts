import {
  boundsInWords,
  coordinate,
  ecefToGeodetic,
  GromaError,
  PlacementError,
  placePoint,
  sourceTransform,
  statedAccuracy,
} from "@groma/georef";
import { type Scan, scanFile } from "../core/core.js";
import { type Row, readRows } from "../given/rows.js";
import { placeInWords } from "../place/describe.js";
import { givenPlaces } from "../place/given-places.js";
import { type Placed, placed } from "../place/placed.js";
import { print, printJson } from "../terminal/output.js";

const DEGREE = Math.PI / 180;

export interface LocateOptions {
  /** File of source coordinates, or of what `inverse` says; `-` for standard input. */
  readonly points: string;
  /** What the points are given in, where they are to be found in source coordinates. */
  readonly inverse?: string;
  readonly json?: boolean;
}

/** Where one point is. */
export interface Located {
  /** Source coordinates as they were asked for, or as they were found; z is the middle of the bounds where none was given. */
  readonly source: readonly [number, number, number];
  /** EPSG:4978, metres. */
  readonly ecef: readonly [number, number, number];
  /** Longitude and latitude in degrees, height above the ellipsoid in metres; WGS 84. */
  readonly geodetic: readonly [number, number, number];
  /** Metres; `null` when it is not known. */
  readonly accuracy: number | null;
}

/**
 * Places points as a page that shows the file does, from the file's own records.
 *
 * @param scan whose bounds, and one step around, the points must lie in: what is known of a place holds there; a rigid
 *   body goes on as it is
 * @throws PlacementError PLACE_DOMAIN with the line of the first point that lies outside or has no place
 */
export function locate({ truth, accuracy, engine }: Placed, rows: readonly Row[], scan: Scan): Located[] {
  const { file } = scan;
  const middle = (scan.min[2] + scan.max[2]) / 2;
  const { total } = statedAccuracy(accuracy);
  const ecef = new Float64Array(3);
  const geodetic = new Float64Array(3);
  return rows.map(({ line, values: [x = 0, y = 0, z = middle] }) => {
    if (engine.name !== "similarity") refuseOutside([x, y, z], line, scan);
    try {
      if (typeof truth === "function") placePoint(truth, x, y, z, ecef, file);
      else truth.forward(x, y, z, ecef);
    } catch (error) {
      if (!(error instanceof GromaError)) throw error;
      throw new PlacementError({ ...error.toWire(), file, cause: `line ${line}: ${error.cause}` });
    }
    ecefToGeodetic(ecef[0]!, ecef[1]!, ecef[2]!, geodetic);
    return {
      source: [x, y, z],
      ecef: [ecef[0]!, ecef[1]!, ecef[2]!],
      geodetic: [geodetic[0]! / DEGREE, geodetic[1]! / DEGREE, geodetic[2]!],
      accuracy: total,
    };
  });
}

/**
 * The source coordinates of places, to 1 µm.
 *
 * @param from `ecef`, `geodetic`, or a map projection, see {@link givenPlaces}
 * @throws PlacementError PLACE_DOMAIN with the line of the first place that no coordinates within the bounds lead to
 * @throws OptionError OPTION_INVERSE
 */
function locateInverse(place: Placed, rows: readonly Row[], scan: Scan, from: string): Located[] {
  const { truth, targets } = givenPlaces(place, rows, scan, from);
  const { min, max, file } = scan;
  const box = { minX: min[0], minY: min[1], maxX: max[0], maxY: max[1] };
  const toSource = sourceTransform(truth, box, file);
  const source = new Float64Array(3);
  const found = targets.map(([x, y, z], index) => {
    const { line } = rows[index]!;
    try {
      toSource(x, y, z, source);
    } catch (error) {
      if (!(error instanceof GromaError)) throw error;
      throw new PlacementError({ ...error.toWire(), file, cause: `line ${line}: ${error.cause}` });
    }
    return { line, values: [...source] };
  });
  return locate(place, found, scan);
}

/** @throws PlacementError PLACE_DOMAIN */
function refuseOutside(point: readonly number[], line: number, { min, max, scale, file }: Scan): void {
  const inside = point.every((value, axis) => {
    // The bounds are numbers in binary: a hundredth of a step is none.
    const step = 1.01 * scale[axis]!;
    return value >= min[axis]! - step && value <= max[axis]! + step;
  });
  if (inside) return;
  const [minX, minY, minZ] = min;
  const [maxX, maxY, maxZ] = max;
  const bounds = boundsInWords({ minX, minY, minZ, maxX, maxY, maxZ });
  throw new PlacementError({
    ...{ code: "PLACE_DOMAIN", file },
    cause: `line ${line}: (${point.map(coordinate).join(", ")}) lies outside of the bounds of the data set (${bounds})`,
    fix: "check the coordinates and their order, easting or longitude first, and the unit of z",
  });
}

/**
 * The `locate` command.
 *
 * @throws RowsError POINTS_*
 * @throws PlacementError PLACE_DOMAIN
 * @throws CoreError, CrsError, RecordError
 */
export async function runLocate(
  file: string,
  { points, inverse, json = false }: LocateOptions,
): Promise<void> {
  const fewest = inverse === undefined ? 2 : 3;
  const rows = await readRows(points, { kind: "POINTS", columns: "x y z", fewest, most: 3 });
  const scan = await scanFile(file);
  const place = await placed(scan);
  const located =
    inverse === undefined ? locate(place, rows, scan) : locateInverse(place, rows, scan, inverse);
  if (json) printJson(locatedJson(place, located));
  else if (inverse === undefined) print(locatedLines(place, located));
  else print(sourceLines(place, located));
}

function locatedJson({ engine, operation, basis }: Placed, points: readonly Located[]) {
  return { points, engine, operation: operation ?? null, crsFrom: basis };
}

/** Digits below the micrometre that the coordinates are right to. */
const ANGULAR_DIGITS = 12;
const LINEAR_DIGITS = 6;

function sourceLines(place: Placed, points: readonly Located[]): string[] {
  const digits = place.crs.horizontalUnit.kind === "angular" ? ANGULAR_DIGITS : LINEAR_DIGITS;
  return [
    whence(place),
    "# x y z (coordinates of the scan)",
    ...points.map(
      ({ source: [x, y, z] }) => `${x.toFixed(digits)} ${y.toFixed(digits)} ${z.toFixed(LINEAR_DIGITS)}`,
    ),
  ];
}

function whence(place: Placed): string {
  const derived = place.basis === "Groma's record" ? "" : `, derived here from the file's ${place.basis}`;
  return `# ${placeInWords(place)}${derived}`;
}

function locatedLines(place: Placed, points: readonly Located[]): string[] {
  return [
    whence(place),
    "# X Y Z (ECEF, m)  longitude latitude (degrees)  height (m)  accuracy (m)",
    ...points.map(({ ecef, geodetic: [longitude, latitude, height], accuracy }) => {
      const degrees = `${longitude.toFixed(10)} ${latitude.toFixed(10)}`;
      const worth = accuracy === null ? "unknown" : accuracy.toFixed(4);
      return `${ecef.map((value) => value.toFixed(4)).join(" ")}  ${degrees}  ${height.toFixed(4)}  ${worth}`;
    }),
  ];
}
