import type { Transformation } from "@groma/georef";
import type { PassedOver } from "./candidate.js";

/** A better operation that PROJ had to leave out. */
export interface Lacking {
  readonly operation: string;
  readonly accuracy: number | null;
  /** Grid files that are not there. */
  readonly grids: readonly string[];
}

/** Which way an engine chose and what it is worth. */
export interface EngineReport {
  readonly engine: { readonly name: "PROJ" | "proj4js"; readonly version: string };
  readonly operation: string;
  /**
   * Metres as published; `null` when nobody has stated it. Where EGM96 stands for a geoid, that of the operation in
   * plane: what EGM96 is worth is told apart.
   */
  readonly accuracy: number | null;
  /** A difference of datums is passed over: the place may be off by hundreds of metres. */
  readonly ballpark: boolean;
  /** Nobody states what the operation is worth for these data: it is meant for another place, or for another time. */
  readonly unstated?: boolean;
  /** Names of the grids that are applied. */
  readonly grids: readonly string[];
  readonly lacking: readonly Lacking[];
  /** Operations that PROJ would have preferred and that cannot be followed. */
  readonly passedOver: readonly PassedOver[];
  /** Certified bound of the projection's fit, metres. */
  readonly fitBound: number;
  /** Points compared with PROJ itself. */
  readonly checkedPoints: number;
  /** To PROJ itself, metres. */
  readonly worstDifference: number;
  /** What else a reader has to know, in words. */
  readonly notes: readonly string[];
}

/** A transformation and what is known of it. */
export interface EngineResult {
  readonly transformation: Transformation;
  readonly report: EngineReport;
}

/** What every engine is asked with. */
export interface EngineOptions {
  /** Metres that the fit of the projection may be off. */
  readonly tolerance?: number | undefined;
  /** For error messages. */
  readonly file?: string | undefined;
  readonly signal?: AbortSignal | undefined;
}

/** Told wherever nobody has named a height reference. */
export const UNKNOWN_HEIGHT_NOTE = "height reference unknown: z is taken for the ellipsoidal height";
