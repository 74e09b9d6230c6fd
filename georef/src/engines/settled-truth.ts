import { requireFields } from "../errors/arguments.js";
import type { CompiledTransformation } from "../transformation/evaluate.js";
import { type ExactTransform, exactTransform } from "./exact.js";
import { recordedTruth, type TruthSources } from "./truth.js";

/**
 * Makes the map of a data set from what its file or its user says. Not reentrant: one per worker.
 *
 * @param middle middle height of the data set, source units
 * @param file name for error messages
 * @throws RecordError RECORD_* when the transformation cannot be read
 * @throws CrsError CRS_UNSUPPORTED
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function truthOf(
  sources: TruthSources,
  middle: number,
  file: string,
): ExactTransform | CompiledTransformation {
  requireFields(
    sources,
    { crs: "object", similarity: "object?", transformation: "bytes?" },
    "truthOf: sources",
  );
  return recordedTruth(sources, file) ?? exactTransform(sources.crs, middle);
}
