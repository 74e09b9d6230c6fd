import { planAttribute } from "./attribute-columns.js";
import { layOut, type PlannedArray } from "./column-plan.js";
import { coloursOf, greatestColour, planColour, planElevation } from "./derived-columns.js";
import type { Appearance, Column, RecordedNode, StorageSpec } from "./protocol.js";

/** What the columns of recorded points are made by. */
export interface RecordColumnSpec extends Pick<StorageSpec, "scale" | "offset"> {
  /** Bits per colour channel that the scan really uses. */
  readonly rgbBits: 8 | 16;
  /** As of {@link Appearance}; undefined where it is not known. */
  readonly ranges: Appearance["ranges"] | undefined;
}

/**
 * One column of some of a node's recorded points, as a node that is drawn has it: `rgb`, `elevation`, or an attribute.
 * @param order indices of the points in the chunk, in the order in which they are drawn
 * @returns undefined where the points have no such attribute
 */
export function recordedColumn(
  name: string,
  records: RecordedNode,
  order: Uint32Array,
  { scale, offset, rgbBits, ranges }: RecordColumnSpec,
): Column | undefined {
  const points = { order, count: order.length, recorded: records.count };
  let made: Column | undefined;
  const sink = (column: Column) => {
    made = column;
  };
  let planned: PlannedArray | undefined;
  if (name === "elevation") {
    const heights = heightsOf(records.xyz, order);
    planned = planElevation(
      points,
      records.xyz,
      heights,
      scale[2],
      offset[2],
      heights[0] * scale[2] + offset[2],
      sink,
    );
  } else if (name === "rgb") {
    const colours = coloursOf(records.attributes);
    planned = colours && planColour(points, colours, rgbBits, sink);
  } else {
    const attribute = records.attributes.find((one) => one.name === name);
    planned = attribute && planAttribute(points, attribute, ranges?.get(name)?.[0], sink);
  }
  if (planned) layOut([planned]);
  return made;
}

/** Bits per colour channel that a node's points use. */
export function colourBits({ count, attributes }: RecordedNode): 8 | 16 {
  const colours = coloursOf(attributes);
  return colours && greatestColour(count, colours) > 255 ? 16 : 8;
}

/** Least and greatest z of some points, recorded integers. */
function heightsOf(xyz: Int32Array, order: Uint32Array): readonly [number, number] {
  let [least, greatest] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const point of order) {
    const z = xyz[3 * point + 2];
    if (z < least) least = z;
    if (z > greatest) greatest = z;
  }
  return [least, greatest];
}
