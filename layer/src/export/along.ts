import { OFFSET, type PaintStyle, type PointPaint, pointPaint } from "../effects/index.js";
import { Pace, type PointBatch, recordNumbers } from "../query/index.js";
import { colourBits, valueReader } from "../workers/index.js";
import { SLICE } from "./columns.js";
import { type ExportOptions, eachBatch, type PointSelection } from "./selection.js";

/** A point as it lies along a line. */
export interface PointAlong {
  chainage: number;
  /** From the line, left positive. */
  offset: number;
  /** Source z. */
  height: number;
  /** The colour that is asked for, 0 to 255; else the scan's own as it is recorded, or a grey. */
  red: number;
  green: number;
  blue: number;
  /** Undefined where the data set has no classes. */
  classification: number | undefined;
}

/** How points are coloured on paper. */
export interface PaintOptions {
  /** As a layer with this style has them. Default: in the scan's own colours. */
  readonly paint?: PaintStyle | undefined;
}

/** Colour of points without one. */
const GREY = 70;

/**
 * Goes through the points of selections with a line, in a fixed order.
 * @param take is given the same object each time
 * @returns number of points
 * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted; what `take` throws
 */
export async function eachAlong(
  selections: readonly PointSelection[],
  options: ExportOptions & PaintOptions,
  take: (point: PointAlong) => void,
): Promise<number> {
  const point: PointAlong = {
    ...{ chainage: 0, offset: 0, height: 0, red: GREY, green: GREY, blue: GREY },
    classification: undefined,
  };
  const place = new Float64Array(2);
  const colour = new Uint8ClampedArray(3);
  const pace = new Pace(options.signal);
  return eachBatch(selections, options, async (batch, wanted, selection) => {
    const { origin, along } = selection;
    const { scale, offset } = origin;
    const { xyz } = batch.records;
    const paint = options.paint && paintOf(options.paint, batch, selection, () => point.offset);
    const [red, green, blue, classification] = numbersOf(batch, ["red", "green", "blue", "classification"]);
    for (let index = 0; index < wanted.length; index++) {
      const record = wanted[index];
      const at = 3 * record;
      point.height = xyz[at + 2] * scale[2] + offset[2];
      const [x, y] = [xyz[at] * scale[0] + offset[0], xyz[at + 1] * scale[1] + offset[1]];
      along?.locate(x, y, place, point.height);
      point.chainage = place[0];
      point.offset = place[1];
      if (paint) {
        paint(record, colour);
        [point.red, point.green, point.blue] = colour;
      } else if (red && green && blue) {
        point.red = red(record);
        point.green = green(record);
        point.blue = blue(record);
      }
      point.classification = classification?.(record);
      take(point);
      if (index % SLICE === 0) await pace.rest();
    }
  });
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
