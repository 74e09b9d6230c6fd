import { expect, it } from "vitest";
import { MeasureError } from "../../errors/index.js";
import { cloudOf, UTM } from "../measure/cloud.fixture.js";
import { type Measurement, MeasureUnits, type NamedValue } from "../measure/index.js";
import { figuresOf, type Showing } from "./figures.js";
import { measureWords } from "./words.js";

const vertex = cloudOf(UTM).vertex(500000, 5300000, 1);
const point: Measurement = { id: "1", kind: "aboveGround", name: "Höhe 1", vertices: [vertex] };
const refusal = new MeasureError({ code: "MEASURE_GROUND", file: "scan", cause: "no ground", fix: "none" });
const german = {
  kind: () => "Höhe",
  noPoint: "kein Punkt",
  reading: (percent: number) => `${percent} % gelesen`,
  failure: (thrown: unknown) => `Fehler ${(thrown as MeasureError).code}`,
};

function labelOf(given: Parameters<typeof measureWords>[0], how: Partial<Showing>): string {
  const drawn = how.missed
    ? { measurements: [], draft: { kind: "aboveGround" as const, vertices: [vertex] } }
    : { measurements: [point], draft: undefined };
  const [figure] = figuresOf(drawn, {
    ...{ edited: undefined, drag: undefined, ahead: undefined, missed: false, worth: {} },
    ...{ units: new MeasureUnits(), words: measureWords(given) },
    ...{ valuesOf: (): NamedValue[] => [], readingOf: () => undefined },
    ...how,
  });
  return `${figure.name}: ${figure.label}`;
}

it.each<[Partial<Showing>, string, string]>([
  [
    { readingOf: () => ({ state: "reading", share: 0.429 }) },
    "Höhe 1: reading points, 42 %",
    "Höhe 1: 42 % gelesen",
  ],
  [
    { readingOf: () => ({ state: "failed", thrown: refusal }) },
    "Höhe 1: no ground",
    "Höhe 1: Fehler MEASURE_GROUND",
  ],
  [
    {
      valuesOf: () => {
        throw refusal;
      },
    },
    "Höhe 1: no ground",
    "Höhe 1: Fehler MEASURE_GROUND",
  ],
  [{ missed: true }, "Above ground: no point here", "Höhe: kein Punkt"],
])("a label is written in the application's words, or in English (%#)", (how, english, other) => {
  expect(labelOf(undefined, how)).toBe(english);
  expect(labelOf(german, how)).toBe(other);
});
