import { constantColumn, type PlannedArray, planArray } from "./column-plan.js";
import type { Column, ColumnData } from "./protocol.js";
import { readerOf, type StoredAttribute, sizeOf, viewOf } from "./stored-attribute.js";

/** How many points there are, and in which order they are drawn. */
export interface DrawnPoints {
  readonly count: number;
  /** Index in the chunk of each drawn point. */
  readonly order: Uint16Array | Uint32Array;
  /** Points of the chunk, where fewer are drawn. Default: {@link count}. */
  readonly recorded?: number;
}

/** Who receives columns as they are made. */
export type ColumnSink = (column: Column) => void;

/** Stored by float32 columns where a point has no value. */
const NO_VALUE = Math.fround(-3.4028234663852886e38);

/**
 * Plans the column of one attribute. Numbers of up to 16 bits and float32 stay as they are recorded. Wider ones become
 * float32, counted from the least value of the data set, with the error of that measured.
 * @param origin least value of the data set in the attribute's unit; undefined: that of these points
 * @returns nothing to make where all points have the same value
 */
export function planAttribute(
  points: DrawnPoints,
  attribute: StoredAttribute,
  origin: number | undefined,
  sink: ColumnSink,
): PlannedArray | undefined {
  const { name, components } = attribute;
  if (isConstant(points.recorded ?? points.count, attribute)) {
    const read = valueReader(attribute);
    sink(
      constantColumn(
        name,
        Array.from({ length: components }, (_, index) => read(0, index)),
      ),
    );
    return undefined;
  }
  return isNarrow(attribute)
    ? planAsRecorded(points, attribute, sink)
    : planAsFloat(points, attribute, origin, sink);
}

/** Whether the stored numbers themselves go into the column. */
function isNarrow({ type, scale, offset, components }: StoredAttribute): boolean {
  const even = scale.slice(0, components).every((step) => step === scale[0]);
  const level = offset.slice(0, components).every((from) => from === offset[0]);
  return even && level && (sizeOf(type) < 4 || type === "float32");
}

const ARRAYS = {
  uint8: Uint8Array,
  int8: Int8Array,
  uint16: Uint16Array,
  int16: Int16Array,
  float32: Float32Array,
} as const;

function planAsRecorded(points: DrawnPoints, attribute: StoredAttribute, sink: ColumnSink): PlannedArray {
  const { name, components, noData } = attribute;
  const fill = (data: ColumnData) => {
    gather(points, attribute, data);
    const float = data instanceof Float32Array;
    if (float) replaceMissing(data, noData);
    const missing = float ? NO_VALUE : noData;
    sink({
      ...{ name, components, data, bound: 0 },
      ...{ scale: attribute.scale[0], offset: attribute.offset[0] },
      ...(missing !== undefined && { noData: Number(missing) }),
    });
  };
  return planArray(ARRAYS[attribute.type as keyof typeof ARRAYS], points.count * components, fill);
}

/** In place of NaN, infinities and the writer's own mark: the GPU compares with one number. */
function replaceMissing(data: Float32Array, noData: number | bigint | undefined): void {
  const mark = noData === undefined ? Number.NaN : Math.fround(Number(noData));
  for (let index = 0; index < data.length; index++) {
    if (!Number.isFinite(data[index]) || data[index] === mark) data[index] = NO_VALUE;
  }
}

/** Puts the stored numbers in drawing order. */
function gather(points: DrawnPoints, attribute: StoredAttribute, data: ColumnData): void {
  const { order, count } = points;
  const { bytes, type, at, stride, shift, mask, components } = attribute;
  if (type === "uint8" && components === 1) {
    for (let point = 0; point < count; point++) {
      data[point] = (bytes[order[point] * stride + at] >> shift) & mask;
    }
    return;
  }
  if ((type === "uint16" || type === "int16") && components === 1) {
    // An int16 array takes the upper half of the range for the negative numbers that it is.
    for (let point = 0; point < count; point++) {
      const from = order[point] * stride + at;
      data[point] = bytes[from] | (bytes[from + 1] << 8);
    }
    return;
  }
  const view = viewOf(bytes);
  const read = readerOf(type);
  const size = sizeOf(type);
  for (let point = 0, to = 0; point < count; point++) {
    const from = order[point] * stride + at;
    for (let index = 0; index < components; index++) data[to++] = read(view, from + index * size);
  }
}

function planAsFloat(
  points: DrawnPoints,
  attribute: StoredAttribute,
  given: number | undefined,
  sink: ColumnSink,
): PlannedArray {
  const { name, components } = attribute;
  const { count, order } = points;
  const fill = (data: Float32Array) => {
    const read = valueReader(attribute);
    const origin = given ?? leastValue(points.recorded ?? points.count, attribute);
    let bound = 0;
    for (let point = 0, to = 0; point < count; point++) {
      for (let index = 0; index < components; index++, to++) {
        const value = read(order[point], index);
        data[to] = value - origin;
        if (Number.isFinite(value) && Number.isFinite(data[to])) {
          // Beside what float32 costs, half a unit in the last place of the float64 sums.
          const off = Math.abs(data[to] + origin - value) + Math.abs(value) * 2 ** -52;
          if (off > bound) bound = off;
        } else data[to] = NO_VALUE;
      }
    }
    sink({ name, components, data, scale: 1, offset: origin, noData: NO_VALUE, bound });
  };
  return planArray(Float32Array, count * components, fill);
}

/** Least value of the points; 0 where none has one. */
function leastValue(count: number, attribute: StoredAttribute): number {
  const read = valueReader(attribute);
  let least = Number.POSITIVE_INFINITY;
  for (let point = 0; point < count; point++) {
    for (let index = 0; index < attribute.components; index++) {
      const value = read(point, index);
      if (value < least && value !== Number.NEGATIVE_INFINITY) least = value;
    }
  }
  return Number.isFinite(least) ? least : 0;
}

/** Reads a point's value in the attribute's unit; NaN where it has none. */
function valueReader(attribute: StoredAttribute): (point: number, component: number) => number {
  const { bytes, at, stride, type, shift, mask, scale, offset, noData } = attribute;
  const view = viewOf(bytes);
  const read = readerOf(type);
  const size = sizeOf(type);
  const mark = noData === undefined ? Number.NaN : Number(noData);
  return (point, component) => {
    const stored = read(view, point * stride + at + component * size);
    if (stored === mark) return Number.NaN;
    return (
      (mask === -1 ? stored : (stored >> shift) & mask) * (scale[component] ?? 1) + (offset[component] ?? 0)
    );
  };
}

/** Whether all points have the same bits: found out fast where they do not, since they differ early. */
export function isConstant(count: number, attribute: StoredAttribute): boolean {
  const { bytes, at, stride, type, shift, mask, components } = attribute;
  const length = sizeOf(type) * components;
  const bits = length === 1 ? mask << shift : -1;
  for (let index = 0; index < length; index++) {
    const first = bytes[at + index];
    for (let point = 1, from = at + index + stride; point < count; point++, from += stride) {
      if (((bytes[from] ^ first) & bits) !== 0) return false;
    }
  }
  return true;
}
