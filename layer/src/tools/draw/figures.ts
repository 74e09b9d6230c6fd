import { MeasureError } from "../../errors/index.js";
import {
  MEASUREMENT_KINDS,
  type Measurement,
  type MeasurementKind,
  type MeasureUnits,
  type NamedValue,
  type Reading,
  type Vertex,
  valuesOf,
  type WorthOptions,
  wordsOf,
} from "../measure/index.js";
import { type Drag, dragged } from "./grip.js";
import type { Drawn } from "./history.js";
import type { ShownFigure } from "./overlay.js";
import type { MeasureWords } from "./words.js";

/** How figures are shown. */
export interface Showing {
  /** The measurement whose vertices can be taken hold of. */
  readonly edited: string | undefined;
  /** A vertex of it that is on its way. */
  readonly drag: Drag | undefined;
  /** Where the figure being drawn would go on. */
  readonly ahead: Vertex | undefined;
  /** Whether a vertex was to be placed where there is no point. */
  readonly missed: boolean;
  readonly units: MeasureUnits;
  readonly words: MeasureWords;
  readonly worth: WorthOptions;
  /** Of a measurement as it is. @throws MeasureError */
  valuesOf(measurement: Measurement): readonly NamedValue[];
  /** How far the values that take reading are. */
  readingOf(measurement: Measurement): Reading | undefined;
}

/** All that is drawn, as it is shown: with the vertex that is on its way, and labels. */
export function figuresOf({ measurements, draft }: Drawn, showing: Showing): ShownFigure[] {
  const { edited, drag, ahead, missed, words } = showing;
  const figures = measurements.map((measurement): ShownFigure => {
    const { id, kind, name, vertices: placed } = measurement;
    const vertices = drag?.grip.id === id ? dragged(placed, drag) : placed;
    const { shape, most } = MEASUREMENT_KINDS[kind];
    const grows = most === Number.POSITIVE_INFINITY;
    // A vertex on its way changes what would be read.
    const reading = vertices === placed ? showing.readingOf(measurement) : undefined;
    const label =
      (kind === "annotation" ? { label: name, wrong: false } : undefined) ??
      (reading && readingLabel(reading, showing)) ??
      labelOf(kind, vertices, showing, () =>
        vertices === placed ? showing.valuesOf(measurement) : valuesOf({ kind, vertices }, showing.worth),
      );
    return { id, name, vertices, shape, open: id === edited, grows, ...label };
  });
  if (!draft) return figures;
  const { kind, vertices } = draft;
  const { shape, most } = MEASUREMENT_KINDS[kind];
  const next = ahead && !vertices.includes(ahead) && vertices.length < most ? [ahead] : [];
  return [
    ...figures,
    {
      ...{
        id: undefined,
        name: words.kind(kind),
        vertices,
        shape,
        open: false,
        grows: false,
        ahead: next[0],
      },
      ...(missed ? { label: words.noPoint, wrong: true } : labelOf(kind, [...vertices, ...next], showing)),
    },
  ];
}

type Label = Pick<ShownFigure, "label" | "wrong">;

/** What is read for a figure; undefined where that was given up. */
function readingLabel(reading: Reading, { units, words }: Showing): Label | undefined {
  switch (reading.state) {
    case "reading":
      return { label: words.reading(Math.floor(100 * reading.share)), wrong: false };
    case "done":
      return { label: textOf(reading.values[0], units), wrong: false };
    case "failed":
      return { label: words.failure(reading.thrown), wrong: true };
    case "stopped":
      return undefined;
  }
}

function textOf(of: NamedValue, units: MeasureUnits): string {
  const { main, worth } = wordsOf(of, units);
  return worth === "" ? main : `${main}\n${worth}`;
}

/** The value that a figure is for, with its worth; or why it has none. */
function labelOf(
  kind: MeasurementKind,
  vertices: readonly Vertex[],
  { units, words, worth }: Showing,
  values: () => readonly NamedValue[] = () => valuesOf({ kind, vertices }, worth),
): Label {
  if (vertices.length < MEASUREMENT_KINDS[kind].least) return { label: "", wrong: false };
  try {
    const [first] = values();
    return { label: first ? textOf(first, units) : "", wrong: false };
  } catch (thrown) {
    if (!(thrown instanceof MeasureError)) throw thrown;
    return { label: words.failure(thrown), wrong: true };
  }
}
