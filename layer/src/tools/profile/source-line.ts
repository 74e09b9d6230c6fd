import { ecefToGeodetic, PlacementError } from "@groma/georef";
import { extendedPlace, type SourceSpace } from "../../clips/index.js";

/** Steps of the iteration, each of which doubles the digits. */
const STEPS = 30;
/** Metres on the ellipsoid in a radian, to the per cent that a tolerance needs. */
const RADIAN = 6.4e6;
/** Metres from a place at which another step makes it right to the last digit. */
const NEAR = 1e-6;
/** Metres within which a place counts as found: kilometres beyond a small scan, the map carried on is no finer. */
const FOUND = 1e-3;
/** Share of the coordinates over which a derivative is taken at least: over less, float64 leaves nothing of it. */
const LEAST_STEP = 1e-6;

/**
 * Longitudes and latitudes in the plane of a data set's source coordinates, by Newton's iteration on the data set's own
 * map, in the middle of its heights. The map is carried on linearly beyond the data set's bounds.
 *
 * @param line longitude and latitude of each vertex, WGS 84, radians
 * @returns x and y of each, source units
 * @throws PlacementError PLACE_DOMAIN where a vertex has no place in that plane
 */
export function sourceLine(
  space: SourceSpace,
  line: readonly (readonly [number, number])[],
  file: string,
): [number, number][] {
  const { min, max } = space.boundingBox;
  const place = extendedPlace(space);
  const middle = [0, 1, 2].map((axis) => (min[axis] + max[axis]) / 2);
  const ecef = new Float64Array(3);
  const geodetic = new Float64Array(3);
  const angles = (x: number, y: number) => {
    place(x, y, middle[2], ecef);
    ecefToGeodetic(ecef[0], ecef[1], ecef[2], geodetic);
    return [geodetic[0], geodetic[1]] as const;
  };
  const size = Math.max(1, ...[min[0], min[1], max[0], max[1]].map(Math.abs));
  const step = Math.max((max[0] - min[0]) / 1000, (max[1] - min[1]) / 1000, LEAST_STEP * size);
  return line.map(([longitude, latitude], index) => {
    let [x, y] = middle;
    let best: { readonly at: [number, number]; readonly off: number } | undefined;
    for (let round = 0; round < STEPS; round++) {
      const [here, above] = angles(x, y);
      const east = turned(longitude - here);
      const north = latitude - above;
      if (!Number.isFinite(east + north)) break;
      const off = RADIAN * Math.hypot(east * Math.cos(latitude), north);
      if (off <= FOUND && off < (best?.off ?? Number.POSITIVE_INFINITY)) best = { at: [x, y], off };
      const a = angles(x + step, y);
      const b = angles(x - step, y);
      const c = angles(x, y + step);
      const d = angles(x, y - step);
      const [ex, nx] = [turned(a[0] - b[0]), a[1] - b[1]];
      const [ey, ny] = [turned(c[0] - d[0]), c[1] - d[1]];
      const determinant = (ex * ny - ey * nx) / (2 * step);
      x += (east * ny - north * ey) / determinant;
      y += (north * ex - east * nx) / determinant;
      // Convergence is quadratic: what is left is far below the last digit.
      if (off <= NEAR && Number.isFinite(x + y)) return [x, y];
    }
    if (best) return best.at;
    throw new PlacementError({
      code: "PLACE_DOMAIN",
      file,
      cause: `vertex ${index + 1} has no place in the coordinates of the scan`,
      fix: "check that the vertices lie near the points, longitude before latitude",
    });
  });
}

/** An angle in (−π, π]. */
function turned(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
