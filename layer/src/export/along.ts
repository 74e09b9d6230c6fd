import { OFFSET, type PaintStyle, type PointPaint, pointPaint } from "../effects/index.js";
import { type PointBatch, recordNumbers } from "../query/index.js";
import { colourBits, valueReader } from "../workers/index.js";
import { type ExportOptions, eachBatch, type PointSelection } from "./selection.js";
import { requireOneHeightUnit } from "./systems.js";

/** A point as it lies along a line. */
export interface PointAlong {
  chainage: number;
  /** From the line, left positive. */
  offset: number;
  /** Source z. */
  height: number;
  /** Undefined where the data set has no classes. */
  classification: number | undefined;
}

/** The same with a colour, 0 to 255: the one that is asked for, else the scan's own as it is recorded, or a grey. */
export interface PaintedPoint extends PointAlong {
  red: number;
  green: number;
  blue: number;
}

/** How points are coloured on paper. */
export interface PaintOptions {
  /** As a layer with this style has them. Default: in the scan's own colours. */
  readonly paint?: PaintStyle | undefined;
}

/** Colour of points without one. */
const GREY = 70;

/** Gives a point what a record has besides its place. */
type Finish<P> = (record: number, point: P) => void;

/**
 * Goes through the points of selections with a line, in a fixed order.
 * @param take is given the same object each time
 * @returns number of points
 * @throws FormatError EXPORT_MIXED where heights are in several units
 * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted; what `take` throws
 */
export async function eachAlong(
  selections: readonly PointSelection[],
  options: ExportOptions,
  take: (point: PointAlong) => void,
): Promise<number> {
  const point = { chainage: 0, offset: 0, height: 0, classification: undefined };
  return goAlong(selections, options, point, () => undefined, take);
}

/** As {@link eachAlong}, with colours. */
export async function eachPainted(
  selections: readonly PointSelection[],
  { paint, ...options }: ExportOptions & PaintOptions,
  take: (point: PaintedPoint) => void,
): Promise<number> {
  const place = { chainage: 0, offset: 0, height: 0, classification: undefined };
  const point: PaintedPoint = { ...place, red: GREY, green: GREY, blue: GREY };
  const finishOf = (batch: PointBatch, selection: PointSelection) =>
    paint ? painting(paint, batch, selection, () => point.offset) : recordedColour(batch);
  return goAlong(selections, options, point, finishOf, take);
}

/** @param finishOf says what each point of a batch is given before it is taken */
async function goAlong<P extends PointAlong>(
  selections: readonly PointSelection[],
  options: ExportOptions,
  point: P,
  finishOf: (batch: PointBatch, selection: PointSelection) => Finish<P> | undefined,
  take: (point: P) => void,
): Promise<number> {
  requireOneHeightUnit(selections);
  const place = new Float64Array(2);
  let last: PointBatch | undefined;
  let finish: Finish<P> | undefined;
  return eachBatch(selections, options, async (batch, wanted, selection) => {
    const { origin, along } = selection;
    const { scale, offset } = origin;
    const { xyz } = batch.records;
    if (batch !== last) finish = finishOf(batch, selection);
    last = batch;
    const [classification] = numbersOf(batch, ["classification"]);
    for (const record of wanted) {
      const at = 3 * record;
      point.height = xyz[at + 2] * scale[2] + offset[2];
      const x = xyz[at] * scale[0] + offset[0];
      const y = xyz[at + 1] * scale[1] + offset[1];
      along?.locate(x, y, place, point.height);
      point.chainage = place[0];
      point.offset = place[1];
      point.classification = classification?.(record);
      finish?.(record, point);
      take(point);
    }
  });
}

/** Colours as they are recorded; grey where a batch has none. */
function recordedColour(batch: PointBatch): Finish<PaintedPoint> {
  const [red, green, blue] = numbersOf(batch, ["red", "green", "blue"]);
  const grey = () => GREY;
  const [r, g, b] = red && green && blue ? [red, green, blue] : [grey, grey, grey];
  return (record, point) => {
    point.red = r(record);
    point.green = g(record);
    point.blue = b(record);
  };
}

/** Colours of a style. @param offset of the point that is coloured, in the unit of its line */
function painting(
  style: PaintStyle,
  batch: PointBatch,
  selection: PointSelection,
  offset: () => number,
): Finish<PaintedPoint> {
  const paint = paintOf(style, batch, selection, offset);
  const colour = new Uint8ClampedArray(3);
  return (record, point) => {
    paint(record, colour);
    [point.red, point.green, point.blue] = colour;
  };
}

/** What colours the points of a batch. @param offset of the point that is coloured, in the unit of its line */
function paintOf(
  style: PaintStyle,
  { records }: PointBatch,
  { origin, geodetic }: PointSelection,
  offset: () => number,
): PointPaint {
  return pointPaint(style, {
    numbersOf: (name) =>
      name === OFFSET ? { value: offset } : recordNumbers(name, records, origin, geodetic),
    rgbBits: style.rgbBits ?? colourBits(records),
  });
}

/** Reads the first number of attributes of a batch, as it is recorded; undefined where the batch lacks one. */
function numbersOf(
  { records }: PointBatch,
  names: readonly string[],
): (((record: number) => number) | undefined)[] {
  return names.map((name) => {
    const found = records.attributes.find((one) => one.name === name);
    return found && valueReader(found);
  });
}
