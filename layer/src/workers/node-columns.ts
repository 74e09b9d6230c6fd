import type { Frame } from "@groma/georef";
import { layOut, type PlannedArray, planArray } from "./column-plan.js";
import { greatestColour, planColour, planElevation, planHeight } from "./derived-columns.js";
import type { Appearance, Column, DataSetSpec, NodeVertices } from "./protocol.js";
import { type OrderedRecords, planField } from "./record-columns.js";
import type { RecordField } from "./record-fields.js";

/** Fields that the column `color` stands for. */
const COLOURS = ["red", "green", "blue"];

/** A node's placed points, as the columns need them. */
export interface PlacedPoints {
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
export type NodeArrays = Pick<NodeVertices, "buffer" | "positions" | "columns" | "order" | "seen">;

/** Makes all arrays of a node. */
export function makeArrays(
  spec: DataSetSpec,
  fields: readonly RecordField[],
  records: OrderedRecords,
  placed: PlacedPoints,
  given: Appearance | undefined,
): NodeArrays {
  const { count } = records;
  const columns: Record<string, Column> = {};
  const sink = (column: Column) => {
    columns[column.name] = column;
  };
  let positions = new Float32Array(0);
  let order = records.order;
  const coloured = spec.pointFormat >= 7;
  const rgbBits = given?.rgbBits ?? (greatestColour(records, spec.pointFormat) > 255 ? 16 : 8);
  const { xyz, heights, frame, bound } = placed;
  const planned: (PlannedArray | undefined)[] = [
    planArray(Float32Array, 3 * count, (array) => {
      placed.place(array);
      positions = array;
    }),
    planOrder(records.order, (array) => {
      order = array;
    }),
    coloured ? planColour(records, rgbBits, sink) : undefined,
    ...fields
      .filter(({ name }) => !COLOURS.includes(name))
      .map((field) => planField(records, field, given?.ranges[field.name]?.[0], sink)),
    planElevation(records, xyz, heights, spec.scale[2], spec.offset[2], spec.heights[0], sink),
    planHeight(() => positions, count, frame, bound, spec.ellipsoidalOrigin, sink),
  ];
  const buffer = layOut(planned.filter((array) => array !== undefined));
  const seen = given ? undefined : { rgbBits, ranges: rangesOf(columns) };
  return { buffer, positions, columns, order, seen };
}

function planOrder(
  order: OrderedRecords["order"],
  sink: (copy: OrderedRecords["order"]) => void,
): PlannedArray {
  const fill = (array: Uint16Array | Uint32Array) => {
    array.set(order);
    sink(array);
  };
  return order instanceof Uint16Array
    ? planArray(Uint16Array, order.length, fill)
    : planArray(Uint32Array, order.length, fill);
}

/** Least and greatest value of each column but the colours; none where no point has a value. */
function rangesOf(columns: Readonly<Record<string, Column>>): Record<string, readonly [number, number]> {
  const ranges: Record<string, readonly [number, number]> = {};
  for (const { name, data, scale, offset, constant, noData } of Object.values(columns)) {
    if (name === "color") continue;
    let least = Number.POSITIVE_INFINITY;
    let greatest = Number.NEGATIVE_INFINITY;
    const take = (value: number) => {
      if (value < least) least = value;
      if (value > greatest) greatest = value;
    };
    for (const value of constant ?? []) take(value);
    for (const stored of data) if (stored !== noData) take(stored * scale + offset);
    if (least <= greatest) ranges[name] = [least, greatest];
  }
  return ranges;
}
