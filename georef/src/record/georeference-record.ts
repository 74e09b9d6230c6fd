import type { Crs } from "../crs/crs.js";
import type { Similarity } from "../engines/truth.js";
import type { AccuracyPart } from "./accuracy.js";

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

/** What an engine says of the way it chose. */
export interface OperationReport {
  /** Name of the operation, as PROJ or EPSG has it. */
  readonly name: string;
  /** Metres as published; `null` when nobody has stated it. */
  readonly accuracy: number | null;
  /** A difference of datums is passed over: the place may be off by hundreds of metres. */
  readonly ballpark: boolean;
  /** Files of the grids whose windows the transformation carries. */
  readonly grids: readonly string[];
  /** Better operations whose grids were not there, with the files they want. */
  readonly lacking: readonly {
    readonly name: string;
    readonly accuracy: number | null;
    readonly grids: readonly string[];
  }[];
  /** Greatest difference to the engine itself over the points compared, metres; `null` where none were. */
  readonly worstDifference: number | null;
  /** In words. */
  readonly notes: readonly string[];
}
