import type { Frame } from "@groma/georef";
import { type DrawnPoints, planAttribute } from "./attribute-columns.js";
import { layOut, type PlannedArray, planArray } from "./column-plan.js";
import {
  COLOUR_CHANNELS,
  coloursOf,
  greatestColour,
  planColour,
  planElevation,
  planHeight,
  planLevelHeight,
} from "./derived-columns.js";
import type { Appearance, Column, DataSetSpec, NodeVertices } from "./protocol.js";
import type { StoredAttribute } from "./stored-attribute.js";

/** A node's placed points, as the columns need them. */
export interface PlacedPoints extends DrawnPoints {
  readonly xyz: Int32Array;
  /** Least and greatest z, LAS integers. */
  readonly heights: readonly [number, number];
  readonly frame: Frame;
  /** Bound of the positions, metres. */
  readonly bound: number;
  /** Puts the positions, in drawing order, into the array. */
  place(positions: Float32Array): void;
}

/** The arrays of a node in one buffer, and what they look like where that was to be found out. */
export type NodeArrays = Pick<
  NodeVertices,
  "buffer" | "positions" | "columns" | "rgbBits" | "order" | "seen"
>;

/** Makes all arrays of a node. */
export function makeArrays(
  spec: DataSetSpec,
  attributes: readonly StoredAttribute[],
  points: PlacedPoints,
  given: Appearance | undefined,
): NodeArrays {
  const { count, xyz, heights, frame, bound } = points;
  const columns = new Map<string, Column>();
  const sink = (column: Column) => {
    columns.set(column.name, column);
  };
  let positions = new Float32Array(0);
  let { order } = points;
  const colours = coloursOf(attributes);
  const own = () => (colours && greatestColour(count, colours) > 255 ? 16 : 8);
  const rgbBits = given?.rgbBitsKnown || given?.rgbBits === 16 ? given.rgbBits : own();
  const planned: (PlannedArray | undefined)[] = [
    planArray(Float32Array, 3 * count, (array) => {
      points.place(array);
      positions = array;
    }),
    planOrder(points.order, (array) => {
      order = array;
    }),
    colours && planColour(points, colours, rgbBits, sink),
    ...attributes
      .filter(({ name }) => !COLOUR_CHANNELS.includes(name))
      .map((attribute) => planAttribute(points, attribute, given?.ranges.get(attribute.name)?.[0], sink)),
    planElevation(points, xyz, heights, spec.scale[2], spec.offset[2], spec.heights[0], sink),
    spec.plane
      ? planLevelHeight(() => positions, count, frame, bound, spec.ellipsoidalOrigin, sink)
      : planHeight(() => positions, count, frame, bound, spec.ellipsoidalOrigin, sink),
  ];
  const buffer = layOut(planned.filter((array) => array !== undefined));
  const seen = given ? undefined : { rgbBits, rgbBitsKnown: false, ranges: rangesOf(columns) };
  return { buffer, positions, columns, rgbBits, order, seen };
}

function planOrder(order: DrawnPoints["order"], sink: (copy: DrawnPoints["order"]) => void): PlannedArray {
  const fill = (array: Uint16Array | Uint32Array) => {
    array.set(order);
    sink(array);
  };
  return order instanceof Uint16Array
    ? planArray(Uint16Array, order.length, fill)
    : planArray(Uint32Array, order.length, fill);
}

/** Least and greatest value of each column but the colours; none where no point has a value. */
function rangesOf(columns: ReadonlyMap<string, Column>): Appearance["ranges"] {
  const ranges = new Map<string, readonly [number, number]>();
  for (const { name, data, scale, offset, constant, noData } of columns.values()) {
    if (name === "rgb") continue;
    let least = Number.POSITIVE_INFINITY;
    let greatest = Number.NEGATIVE_INFINITY;
    const take = (value: number) => {
      if (value < least) least = value;
      if (value > greatest) greatest = value;
    };
    for (const value of constant ?? []) take(value);
    for (const stored of data) if (stored !== noData) take(stored * scale + offset);
    if (least <= greatest) ranges.set(name, [least, greatest]);
  }
  return ranges;
}
