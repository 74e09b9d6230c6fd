import { covariance } from "../cartesian/covariance.js";
import { symmetricEigen } from "../cartesian/eigen.js";
import { geodeticToEcef } from "../ellipsoid/geodetic-to-ecef.js";
import type { Similarity } from "../engines/truth.js";
import { requireKind } from "../errors/arguments.js";
import { ControlError } from "../errors/errors.js";
import { bestRotation } from "./rotation.js";

/** A point whose place is known. */
export interface ControlPoint {
  /** Source coordinates. */
  readonly source: readonly [number, number, number];
  /** Longitude, latitude (radians) and height above the ellipsoid (metres), WGS 84. */
  readonly geodetic: readonly [number, number, number];
}

/** The similarity that fits control points best, and how well it does. */
export interface FittedSimilarity {
  readonly similarity: Similarity;
  /** Metres per source unit. */
  readonly scale: number;
  /** Metres from where each point should be to where it is put, in the order of the points. */
  readonly residuals: readonly number[];
  /** Root of the mean square of the residuals, metres. */
  readonly rms: number;
  /** The greatest residual, metres. */
  readonly max: number;
}

const FEWEST = 3;
/** Points that stay within this share of their extent from a line leave the turn about it open. */
const COLLINEAR = 1e-3;
/** Points closer together than this share of their coordinates are one place. */
const COINCIDENT = 1e-9;
/** Residuals beyond this share of the extent mean that coordinates are mixed up. */
const MISMATCH = 0.1;

/**
 * Fits seven parameters (translation, rotation, one scale) in closed form, least squares in ECEF: rotation by Horn's
 * quaternions, scale by Umeyama, "Least-squares estimation of transformation parameters between two point patterns",
 * IEEE Trans. PAMI 13 (1991) 376–380, equation 42.
 *
 * @param file name for error messages
 * @throws ControlError CONTROL_TOO_FEW, CONTROL_RANGE, CONTROL_DEGENERATE, CONTROL_COLLINEAR, CONTROL_MISMATCH
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function fitSimilarity(points: readonly ControlPoint[], file: string): FittedSimilarity {
  requireKind(points, "list", "fitSimilarity: points");
  if (points.length < FEWEST) {
    const cause = `${points.length} control point${points.length === 1 ? " is" : "s are"} not enough`;
    throw refusal("CONTROL_TOO_FEW", file, cause, `give at least ${FEWEST} that are not on one line`);
  }
  const sources = Float64Array.from(points.flatMap(({ source }) => source));
  const targets = new Float64Array(3 * points.length);
  for (const [i, { geodetic }] of points.entries()) {
    if (!isOnEarth(geodetic) || !points[i].source.every(Number.isFinite)) {
      const fix = "give x y z, then longitude and latitude in degrees and the height in metres";
      throw refusal("CONTROL_RANGE", file, `control point ${i + 1} is no place`, fix);
    }
    geodeticToEcef(...geodetic, targets, 3 * i);
  }
  const from = cloud(sources, file, "source coordinates");
  const to = cloud(targets, file, "places");

  const sums = new Float64Array(9);
  let squares = 0;
  for (let i = 0; i < sources.length; i += 3) {
    for (let row = 0; row < 3; row++) {
      const a = sources[i + row] - from.mean[row];
      squares += a * a;
      for (let column = 0; column < 3; column++) {
        sums[3 * row + column] += a * (targets[i + column] - to.mean[column]);
      }
    }
  }
  const rotation = bestRotation(sums);
  let trace = 0;
  for (let i = 0; i < 9; i++) trace += rotation[i] * sums[3 * (i % 3) + Math.floor(i / 3)];
  const scale = trace / squares;
  const matrix = rotation.map((value) => scale * value);
  const origin = (axis: number) => to.mean[axis] - along(matrix, axis, from.mean, 0);
  const similarity: Similarity = { translation: [origin(0), origin(1), origin(2)], matrix };

  const residuals = points.map((_, i) => {
    const off = (axis: number) =>
      to.mean[axis] + difference(matrix, axis, sources, 3 * i, from.mean) - targets[3 * i + axis];
    return Math.hypot(off(0), off(1), off(2));
  });
  const rms = Math.hypot(...residuals) / Math.sqrt(residuals.length);
  if (!(rms <= MISMATCH * to.extent)) {
    throw refusal(
      ...([
        "CONTROL_MISMATCH",
        file,
        `the control points cannot be brought together, ${rms} m remain`,
      ] as const),
      "check the order of the columns: x y z longitude latitude height, and that x, y, z are right-handed",
    );
  }
  return { similarity, scale, residuals, rms, max: Math.max(...residuals) };
}

function isOnEarth([longitude, latitude, height]: readonly number[]): boolean {
  return Math.abs(longitude) <= 2 * Math.PI && Math.abs(latitude) <= Math.PI / 2 && Number.isFinite(height);
}

/** Row of a 3 × 3 matrix times a vector. */
function along(matrix: readonly number[], row: number, v: ArrayLike<number>, at: number): number {
  return matrix[3 * row] * v[at] + matrix[3 * row + 1] * v[at + 1] + matrix[3 * row + 2] * v[at + 2];
}

function difference(
  matrix: readonly number[],
  row: number,
  points: Float64Array,
  at: number,
  mean: ArrayLike<number>,
): number {
  const v = [points[at] - mean[0], points[at + 1] - mean[1], points[at + 2] - mean[2]];
  return along(matrix, row, v, 0);
}

/** Mean and extent (root of the greatest eigenvalue of the covariance) of points that span a plane at least. */
function cloud(
  points: Float64Array,
  file: string,
  what: string,
): { mean: ArrayLike<number>; extent: number } {
  const { mean, matrix } = covariance(points);
  const [, middle, greatest] = symmetricEigen(matrix).values;
  const extent = Math.sqrt(Math.max(0, greatest));
  if (!(extent > COINCIDENT * Math.hypot(mean[0], mean[1], mean[2]))) {
    const fix = "give points that are spread over the data set";
    throw refusal("CONTROL_DEGENERATE", file, `the ${what} of the control points are one place`, fix);
  }
  if (!(Math.sqrt(Math.max(0, middle)) > COLLINEAR * extent)) {
    const fix = "give one more control point off the line: the turn about it is open";
    throw refusal("CONTROL_COLLINEAR", file, `the ${what} of the control points lie on one line`, fix);
  }
  return { mean, extent };
}

function refusal(code: string, file: string, cause: string, fix: string): ControlError {
  return new ControlError({ code, file, cause, fix });
}
