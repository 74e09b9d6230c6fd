import type { Crs } from "../crs/crs.js";
import { requireFields } from "../errors/arguments.js";
import { coordinate } from "../errors/coordinates.js";
import { PlacementError } from "../errors/errors.js";
import { decodeTransformation } from "../transformation/decode.js";
import {
  type CompiledTransformation,
  compileTransformation,
  type StepwiseTruth,
} from "../transformation/evaluate.js";
import type { PointTransform } from "../transformation/link.js";
import type { ExactTransform } from "./exact.js";

/**
 * The one map of a data set, source coordinates → ECEF (or the plane of a map), whatever it was made from: proj4js and a similarity are exactly
 * linear in z, a transformation with the grids of PROJ is not. {@link fitPlacement} takes either.
 */
export type Truth = ExactTransform | StepwiseTruth;

/**
 * A data set without a coordinate reference system, put on the globe as a rigid body with one scale:
 * ECEF (metres) = translation + matrix · (x, y, z).
 */
export interface Similarity {
  /** ECEF of the source's origin, metres. */
  readonly translation: readonly [number, number, number];
  /** Row-major 3 × 3: a rotation times metres per source unit. */
  readonly matrix: readonly number[];
}

/** What is known of where a data set is, the most exact last. */
export interface TruthSources {
  readonly crs: Pick<Crs, "proj4" | "horizontalUnit" | "verticalUnit" | "height">;
  readonly similarity?: Similarity | undefined;
  /** Payload of the VLR `groma`/3 (docs/transformation.md). */
  readonly transformation?: Uint8Array | undefined;
}

/**
 * The map of a data set that its record holds, a transformation or a similarity. It needs no projection of proj4js. Not
 * reentrant: one per worker.
 *
 * @param file name for error messages
 * @returns undefined where only the CRS says where the data set is: `truthOf`
 * @throws RecordError RECORD_* when the transformation cannot be read
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function recordedTruth(
  sources: Pick<TruthSources, "similarity" | "transformation">,
  file: string,
): ExactTransform | CompiledTransformation | undefined {
  requireFields(sources, { similarity: "object?", transformation: "bytes?" }, "recordedTruth: sources");
  const { similarity, transformation } = sources;
  if (transformation) return compileTransformation(decodeTransformation(transformation, file), file);
  return similarity && similarityTransform(similarity);
}

/**
 * P and n of a similarity: P = translation + matrix · (x, y, 0), n = matrix · (0, 0, 1).
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function similarityTransform(similarity: Similarity): ExactTransform {
  requireFields(similarity, { translation: "numbers", matrix: "numbers" }, "similarityTransform: similarity");
  const { translation, matrix } = similarity;
  return (x, y, out, offset) => {
    for (let axis = 0; axis < 3; axis++) {
      out[offset + axis] = translation[axis] + matrix[3 * axis] * x + matrix[3 * axis + 1] * y;
      out[offset + axis + 3] = matrix[3 * axis + 2];
    }
  };
}

/** The map as a function of points: ECEF, NaN where there is no such place. Not reentrant. */
export function pointTransform(truth: Truth): PointTransform {
  if (typeof truth !== "function") return truth.evaluate;
  const parts = new Float64Array(6);
  return (x, y, z, out, offset) => {
    truth(x, y, parts, 0);
    for (let axis = 0; axis < 3; axis++) out[offset + axis] = parts[axis] + z * parts[axis + 3];
  };
}

/**
 * One point in ECEF.
 *
 * @throws PlacementError PLACE_DOMAIN where the map has no such place
 */
export function placePoint(
  truth: Truth,
  x: number,
  y: number,
  z: number,
  out: Float64Array,
  file = "points",
): void {
  pointTransform(truth)(x, y, z, out, 0);
  if (Number.isFinite(out[0]) && Number.isFinite(out[1]) && Number.isFinite(out[2])) return;
  throw new PlacementError({
    ...{
      code: "PLACE_DOMAIN",
      file,
      cause: `(${[x, y, z].map(coordinate).join(", ")}) cannot be transformed with this data set's CRS`,
    },
    fix: "check the coordinates and their order, easting or longitude first",
  });
}
