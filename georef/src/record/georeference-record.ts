import type { Crs } from "../crs/crs.js";
import type { Similarity } from "../engines/truth.js";
import type { AccuracyPart } from "./accuracy.js";
import type { OperationReport } from "./operation-report.js";

/**
 * What a file says about where its points are: VLR with user id `groma` and record id 1, a JSON object in UTF-8.
 * Members that a later writer adds are passed over; a changed meaning has another version.
 */
export interface GeoreferenceRecord {
  readonly version: 1;
  readonly crs: Crs;
  /** What computes the transformation that the record stands for. */
  readonly engine: { readonly name: "PROJ" | "proj4js" | "similarity"; readonly version: string };
  /** The operation that the engine chose, and what a reader has to know of it; absent in records of version 0.1. */
  readonly operation?: OperationReport;
  /** For a data set without a coordinate reference system: where it was put. `crs.proj4` then means nothing. */
  readonly similarity?: Similarity;
  /** Parts that hold for the whole data set. */
  readonly accuracy: readonly AccuracyPart[];
}
