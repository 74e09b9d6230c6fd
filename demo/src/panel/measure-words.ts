import {
  MEASUREMENT_KINDS,
  MeasureUnits,
  type MeasureUnitsOptions,
  type MeasureWords,
  type NamedValue,
  type WorthWords,
} from "@groma/layer/tools";
import { i18n } from "../language/i18n.js";
import { libraryWords } from "../language/library-words.js";
import { shortlyOf } from "./fault-words.js";

/** What tools for drawing say. */
export const MEASURE_WORDS: MeasureWords = {
  measure: i18n.t("Measure"),
  undo: i18n.t("Undo"),
  redo: i18n.t("Redo"),
  kind: (kind) => libraryWords(MEASUREMENT_KINDS[kind].title),
  measurements: i18n.t("Measurements"),
  noPoint: i18n.t("no point here"),
  reading: (percent) => i18n.t("reading points, {percent} %", { percent }),
  failure: shortlyOf,
  vertex: (number, name) => i18n.t("Vertex {number} of {name}", { number, name }),
  vertexAfter: (number, name) => i18n.t("Add a vertex after {number} of {name}", { number, name }),
};

const WORTH_WORDS: WorthWords = {
  unknown: i18n.t("± unknown"),
  atLeast: (worth) => i18n.t("at least {worth}", { worth }),
};

/** Units for values, in the reader's language. */
export function unitsOf(chosen: readonly (MeasureUnitsOptions | undefined)[]): MeasureUnits {
  return new MeasureUnits(Object.assign({ locale: i18n.locale, words: WORTH_WORDS }, ...chosen));
}

/** What a value of a measurement is called. */
export function titleOf({ title }: Pick<NamedValue, "title">): string {
  const [, number] = /^part (\d+)$/.exec(title) ?? [];
  return number === undefined ? libraryWords(title) : i18n.t("part {number}", { number });
}
