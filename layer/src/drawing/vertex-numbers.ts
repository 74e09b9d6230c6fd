import type { ColumnData } from "../workers/index.js";

const ARRAYS = {
  uint8: Uint8Array,
  int8: Int8Array,
  uint16: Uint16Array,
  int16: Int16Array,
  uint32: Uint32Array,
  int32: Int32Array,
  float32: Float32Array,
} as const;

/** How the numbers of an attribute are stored in a buffer. */
export type VertexNumbers = keyof typeof ARRAYS;

const NAMES = Object.keys(ARRAYS) as VertexNumbers[];

/** Which numbers a column is made of. */
export function numbersOf(data: ColumnData): VertexNumbers {
  return NAMES.find((name) => data instanceof ARRAYS[name]) ?? "float32";
}

/** Bytes of a number. */
export function bytesOf(numbers: VertexNumbers): number {
  return ARRAYS[numbers].BYTES_PER_ELEMENT;
}

/** What a value that all points share can be stored as without another number coming of it, the shortest first. */
export function numbersFor(values: readonly number[]): VertexNumbers[] {
  return NAMES.filter(
    (name) => name === "float32" || values.every((value) => ARRAYS[name].of(value)[0] === value),
  ).sort((a, b) => bytesOf(a) - bytesOf(b));
}

/** A value for each of so many points. */
export function repeated(values: readonly number[], count: number, numbers: VertexNumbers): ColumnData {
  const data = new ARRAYS[numbers](count * values.length);
  for (let at = 0; at < data.length; at++) data[at] = values[at % values.length];
  return data;
}
