import { GromaError } from "@groma/georef";
import { MEASUREMENT_KINDS, type MeasurementKind } from "../measure/index.js";

/** What a `MeasureTool` and its bar say to people, in the language of the application. */
export interface MeasureWords {
  /** What the tool bar is called. */
  readonly measure: string;
  readonly undo: string;
  readonly redo: string;
  /** A kind of measurement: its button, and with a number the name of what is measured. */
  readonly kind: (kind: MeasurementKind) => string;
  /** All that is measured, as a group. */
  readonly measurements: string;
  /** Where a click met no point. */
  readonly noPoint: string;
  /** @param percent of the points that a value takes, whole */
  readonly reading: (percent: number) => string;
  /** Why a figure has no value, for its label. @param thrown most often a `GromaError`, whose `cause` is English */
  readonly failure: (thrown: unknown) => string;
  /** A vertex that can be moved. @param number from 1 on; @param name of the measurement */
  readonly vertex: (number: number, name: string) => string;
  /** What adds a vertex after another. */
  readonly vertexAfter: (number: number, name: string) => string;
}

const ENGLISH: MeasureWords = {
  measure: "Measure",
  undo: "Undo",
  redo: "Redo",
  kind: (kind) => MEASUREMENT_KINDS[kind].title,
  measurements: "Measurements",
  noPoint: "no point here",
  reading: (percent) => `reading points, ${percent} %`,
  failure: (thrown) => (thrown instanceof GromaError ? thrown.cause : "it could not be read"),
  vertex: (number, name) => `Vertex ${number} of ${name}`,
  vertexAfter: (number, name) => `Add a vertex after ${number} of ${name}`,
};

/** Words that were given, and English for the others. */
export function measureWords(given: Partial<MeasureWords> = {}): MeasureWords {
  return { ...ENGLISH, ...given };
}
