import { stationText } from "../../tools/sections/station.js";
import {
  BLACK,
  type Colour,
  GRID,
  GROUND,
  type Pixels,
  type Sheet,
  type SheetLine,
  type SheetText,
} from "./sheet.js";

/** Places of the plot on the sheet, millimetres. */
const MARGIN = { left: 24, right: 8, bottom: 20 } as const;

/** Below the upper edge: the title, and each line of facts. */
const TITLE = 14;
const FACT = 3.2;

/** Sheets of ISO 216, lying, from A4 on; a drawing that is larger than A0 gets a sheet of its own size. */
const PAPERS = [
  [297, 210],
  [420, 297],
  [594, 420],
  [841, 594],
  [1189, 841],
] as const;

/** Width of a plot on A3, which the default scale is chosen for. */
const PLOT_WIDTH = 420 - MARGIN.left - MARGIN.right;

/** Scales are 1 to one of these, times a power of ten. */
const STEPS = [1, 2, 2.5, 5] as const;

/** Millimetres between lines of the grid, at least. */
const GRID_DISTANCE = 15;

/** What stands on a sheet in words. */
export interface PictureWords {
  readonly title: string;
  /** Lines below the title: data set, coordinate reference system, number of points. */
  readonly facts: readonly string[];
  /** Unit of lengths. */
  readonly unit: string;
  /** Of the horizontal axis, with its unit. */
  readonly along: string;
  /** The station of a chainage, which the axis then has. */
  readonly stationOf?: ((chainage: number) => number) | undefined;
  /** Of the vertical axis, with its unit and the height reference. */
  readonly up: string;
}

/** What a plot shows, in the units of its axes. */
export interface PlotFrame {
  /** Chainage at the left and right edge. */
  readonly from: number;
  readonly to: number;
  /** Millimetres per unit of either axis. */
  readonly along: number;
  readonly up: number;
}

/** The largest of the round scales 1 : n at which a length fits onto A3. @param metres length of the line */
export function fittingScale(metres: number): number {
  return roundScale((1000 * metres) / PLOT_WIDTH);
}

/** The largest of the round scales 1 : n that is not larger than 1 : `least`, but for the digits of a float. */
export function roundScale(least: number): number {
  for (let power = 10 ** Math.floor(Math.log10(Math.max(least, 1e-3))); ; power *= 10) {
    const found = STEPS.find((step) => step * power >= least * (1 - 1e-9));
    if (found !== undefined) return found * power;
  }
}

/** The least round number (1, 2 or 5 times a power of ten) that is not below another. */
export function roundStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((step) => step * power).find((step) => step >= least * (1 - 1e-12))!;
}

/** A number with as many digits as a step of the axis has. */
function axisText(value: number, step: number): string {
  return value.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}

/** What stands at marks of the horizontal axis: chainages, or stations with the digits that all of them need. */
function marksInWords(
  marks: readonly number[],
  step: number,
  stationOf: PictureWords["stationOf"],
): readonly string[] {
  if (!stationOf) return marks.map((chainage) => axisText(chainage, step));
  const stations = marks.map(stationOf);
  const isEven = (digits: number) =>
    stations.every((station) => Math.abs(station * 10 ** digits - Math.round(station * 10 ** digits)) < 1e-6);
  const digits = [0, 1, 2].find(isEven) ?? 3;
  return stations.map((station) => stationText(station, digits));
}

/**
 * Puts a plot onto a sheet: dots, grid in round numbers, axes, terrain line, scale bar, words.
 *
 * @param dots pixels and the height at their lower edge, and how large a pixel is, millimetres
 * @param scale of lengths and of heights, 1 : n, for the words
 */
export function layOut(
  frame: PlotFrame,
  dots: { readonly pixels: Pixels; readonly bottom: number; readonly pitch: number },
  runs: readonly (readonly (readonly [number, number])[])[],
  words: PictureWords,
  scale: { readonly along: number; readonly up: number },
): Sheet {
  const top = dots.bottom + (dots.pixels.rows * dots.pitch) / frame.up;
  const step = {
    along: roundStep(GRID_DISTANCE / frame.along),
    up: roundStep(GRID_DISTANCE / frame.up / 1.5),
  };
  const low = Math.floor(dots.bottom / step.up) * step.up;
  const high = Math.max(Math.ceil(top / step.up), Math.floor(low / step.up + 1.5)) * step.up;
  const size = { x: (frame.to - frame.from) * frame.along, y: (high - low) * frame.up };
  const facts = [...words.facts, scaleWords(scale)];
  const head = TITLE + FACT * facts.length;
  const [width, height] = paperFor(MARGIN.left + size.x + MARGIN.right, MARGIN.bottom + size.y + head);
  const { left } = MARGIN;
  const base = height - head - size.y;
  const area = { left, base, width: size.x, height: size.y };
  const x = (chainage: number) => left + (chainage - frame.from) * frame.along;
  const y = (z: number) => base + (z - low) * frame.up;
  const marks = multiples(frame.from, frame.to, step.along);
  const markTexts = marksInWords(marks, step.along, words.stationOf);
  const levels = multiples(low, high, step.up);
  const bar = scaleBar(frame.along, words.unit, left, base - 14);
  const ground = runs.filter((run) => run.length > 1);
  const { pixels, pitch, bottom } = dots;
  const image = {
    ...pixels,
    x: left,
    y: y(bottom),
    width: pixels.columns * pitch,
    height: pixels.rows * pitch,
  };
  return {
    ...{ width, height, title: words.title, images: [image] },
    lines: [
      ...grid(marks.map(x), levels.map(y), area),
      ...ground.map((run) =>
        stroke(
          run.map(([chainage, z]) => [x(chainage), y(z)] as const),
          0.25,
          GROUND,
        ),
      ),
      bar.line,
    ],
    texts: [
      ...marks.map((mark, index) => markText(markTexts[index], x(mark), base)),
      ...levels.map((z) => levelText(axisText(z, step.up), y(z))),
      ...captions(words, facts, area, height),
      bar.text,
    ],
  };
}

/** Where the plot lies on its sheet, millimetres: its lower left corner, and its size. */
interface PlotArea {
  readonly left: number;
  readonly base: number;
  readonly width: number;
  readonly height: number;
}

function stroke(places: SheetLine["places"], width: number, colour: Colour): SheetLine {
  return { places, width, colour };
}

/** Lines upright at some x and level at some y, millimetres, and the border around them. */
function grid(
  xs: readonly number[],
  ys: readonly number[],
  { left, base, width, height }: PlotArea,
): SheetLine[] {
  const [right, ceiling] = [left + width, base + height];
  const border = [
    [left, base],
    [right, base],
    [right, ceiling],
    [left, ceiling],
    [left, base],
  ] as const;
  return [
    ...xs.map((x) => stroke([[x, base] as const, [x, ceiling] as const], 0.1, GRID)),
    ...ys.map((y) => stroke([[left, y] as const, [right, y] as const], 0.1, GRID)),
    stroke(border, 0.2, BLACK),
  ];
}

/** What stands below a line of the grid. */
function markText(text: string, x: number, base: number): SheetText {
  return { text, x, y: base - 4, size: 2.5, anchor: "middle" };
}

/** What stands to the left of one. */
function levelText(text: string, y: number): SheetText {
  return { text, x: MARGIN.left - 1.5, y: y - 0.9, size: 2.5, anchor: "end" };
}

/** The words of both axes, the title, and the facts below it. @param top of the sheet, millimetres */
function captions(
  words: PictureWords,
  facts: readonly string[],
  { left, base, width, height }: PlotArea,
  top: number,
): SheetText[] {
  return [
    { text: words.along, x: left + width / 2, y: base - 8, size: 2.8, anchor: "middle" },
    { text: words.up, x: left - 14, y: base + height / 2, size: 2.8, anchor: "middle", upwards: true },
    { text: words.title, x: left, y: top - 9, size: 4.2, anchor: "start" },
    ...facts.map((text, index): SheetText => {
      return { text, x: left, y: top - TITLE - FACT * index, size: 2.3, anchor: "start" };
    }),
  ];
}

/** A bar of a round length of some four centimetres, for whoever has a ruler; x and y of its left end, millimetres. */
function scaleBar(
  along: number,
  unit: string,
  x: number,
  y: number,
): { readonly line: SheetLine; readonly text: SheetText } {
  const length = roundStep(30 / along);
  const end = x + length * along;
  const places = [
    [x, y + 1],
    [x, y],
    [end, y],
    [end, y + 1],
  ] as const;
  return {
    line: stroke(places, 0.3, BLACK),
    text: {
      text: `${axisText(length, length)} ${unit}`,
      ...{ x: end + 1.5, y: y - 0.5, size: 2.3, anchor: "start" },
    },
  };
}

function paperFor(width: number, height: number): readonly [number, number] {
  return PAPERS.find(([w, h]) => w >= width && h >= height) ?? [Math.ceil(width), Math.ceil(height)];
}

function multiples(from: number, to: number, step: number): number[] {
  const [first, last] = [Math.ceil(from / step - 1e-9), Math.floor(to / step + 1e-9)];
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, index) => (first + index) * step);
}

/** Both scales, as one where they are one. */
function scaleWords({ along, up }: { readonly along: number; readonly up: number }): string {
  return along === up ? `1:${scaleText(along)}` : `lengths 1:${scaleText(along)}, heights 1:${scaleText(up)}`;
}

function scaleText(scale: number): string {
  return String(Number(scale.toPrecision(6)));
}
