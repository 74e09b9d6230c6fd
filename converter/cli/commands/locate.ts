import { ecefToGeodetic, GromaError, PlacementError, placePoint, statedAccuracy } from "@groma/georef";
import { scanFile } from "../core/core.js";
import { type Row, readRows } from "../given/rows.js";
import { placeInWords } from "../place/describe.js";
import { type Placed, placed } from "../place/placed.js";
import { print, printJson } from "../terminal/output.js";

const DEGREE = Math.PI / 180;

export interface LocateOptions {
  /** File of source coordinates, `-` for standard input. */
  readonly points: string;
  readonly json?: boolean;
}

/** Where one point is. */
export interface Located {
  /** Source coordinates as they were asked for; z is 0 where none was given. */
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
 * @param file for error messages
 * @throws PlacementError PLACE_DOMAIN with the line of the first point that has no place
 */
export function locate({ truth, accuracy }: Placed, rows: readonly Row[], file: string): Located[] {
  const { total } = statedAccuracy(accuracy);
  const ecef = new Float64Array(3);
  const geodetic = new Float64Array(3);
  return rows.map(({ line, values: [x = 0, y = 0, z = 0] }) => {
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
 * The `locate` command.
 *
 * @throws RowsError POINTS_*
 * @throws PlacementError PLACE_DOMAIN
 * @throws CoreError, CrsError, RecordError
 */
export async function runLocate(file: string, { points, json = false }: LocateOptions): Promise<void> {
  const rows = await readRows(points, { kind: "POINTS", columns: "x y z", fewest: 2, most: 3 });
  const place = await placed(await scanFile(file));
  const located = locate(place, rows, file);
  if (json) printJson(locatedJson(place, located));
  else print(locatedLines(place, located));
}

function locatedJson({ engine, operation, basis }: Placed, points: readonly Located[]) {
  return { points, engine, operation: operation ?? null, crsFrom: basis };
}

function locatedLines(place: Placed, points: readonly Located[]): string[] {
  const whence = place.basis === "Groma's record" ? "" : `, derived here from the file's ${place.basis}`;
  return [
    `# ${placeInWords(place)}${whence}`,
    "# X Y Z (ECEF, m)  longitude latitude (degrees)  height (m)  accuracy (m)",
    ...points.map(({ ecef, geodetic: [longitude, latitude, height], accuracy }) => {
      const degrees = `${longitude.toFixed(10)} ${latitude.toFixed(10)}`;
      const worth = accuracy === null ? "unknown" : accuracy.toFixed(4);
      return `${ecef.map((value) => value.toFixed(4)).join(" ")}  ${degrees}  ${height.toFixed(4)}  ${worth}`;
    }),
  ];
}
