import type { Column, ColumnData } from "./protocol.js";

/** A kind of typed array. */
interface ArrayKind<T extends ColumnData> {
  readonly BYTES_PER_ELEMENT: number;
  new (buffer: ArrayBuffer, byteOffset: number, length: number): T;
}

/** An array of a node's buffer that is yet to be made. */
export interface PlannedArray {
  /** Bytes that it takes. */
  readonly bytes: number;
  /** Makes and fills it. */
  fill(buffer: ArrayBuffer, at: number): void;
}

/** Plans a typed array of `length` numbers. */
export function planArray<T extends ColumnData>(
  kind: ArrayKind<T>,
  length: number,
  fill: (array: T) => void,
): PlannedArray {
  return {
    bytes: kind.BYTES_PER_ELEMENT * length,
    fill: (buffer, at) => fill(new kind(buffer, at, length)),
  };
}

/** Lays the arrays out one after the other in one buffer, each at a multiple of four bytes, and fills them. */
export function layOut(planned: readonly PlannedArray[]): ArrayBuffer {
  const starts: number[] = [];
  let end = 0;
  for (const { bytes } of planned) {
    starts.push(end);
    end += Math.ceil(bytes / 4) * 4;
  }
  const buffer = new ArrayBuffer(end);
  for (const [index, array] of planned.entries()) array.fill(buffer, starts[index]);
  return buffer;
}

/**
 * A column whose points all have the same value.
 * @param bound greatest distance of it from a record's
 */
export function constantColumn(name: string, constant: readonly number[], bound = 0): Column {
  const components = constant.length as Column["components"];
  return { name, components, data: new Uint8Array(0), scale: 1, offset: 0, constant, bound };
}

/** Half a unit in the last place of a float32 of this magnitude: what rounding to float32 costs at most. */
export function halfUlp32(magnitude: number): number {
  return magnitude > 0 ? 2 ** (Math.max(-126, Math.floor(Math.log2(magnitude))) - 24) : 0;
}
