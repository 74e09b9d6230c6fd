import type { ByteReader } from "./bytes.js";
import { ByteWriter } from "./bytes.js";

/** How the values of a window are stored. */
const RAW = 0;
const DECIMAL = 1;

/** Powers of ten that are tried: grids are published rounded to a tenth or a hundredth of their accuracy. */
const DECIMALS_MAX = 9;
/** Integers up to here, and their predictions from three neighbours, are exact in float64 and as varints. */
const INTEGER_MAX = 2 ** 45;

interface Shape {
  readonly columns: number;
  readonly rows: number;
  readonly channels: number;
}

/**
 * Writes float32 values without loss. Most grids hold decimals: if all values are integers · 10^−k rounded to float32,
 * the differences of those integers from what their neighbours let expect take one or two bytes each.
 */
export function writeGridValues(writer: ByteWriter, values: Float32Array, shape: Shape): void {
  const decimal = decimalCode(values, shape);
  if (decimal && decimal.length < 4 * values.length) {
    writer.raw(decimal);
    return;
  }
  writer.u8(RAW);
  for (const value of values) writer.f32(value);
}

/** @throws RecordError RECORD_TRUNCATED, RECORD_INVALID */
export function readGridValues(reader: ByteReader, shape: Shape): Float32Array {
  const count = shape.columns * shape.rows * shape.channels;
  const code = reader.u8();
  reader.check(code === RAW || code === DECIMAL, `grid values stored in an unknown way (${code})`);
  if (code === RAW) {
    reader.require(4 * count);
    return Float32Array.from({ length: count }, () => reader.f32());
  }
  const decimals = reader.u8();
  reader.check(decimals <= DECIMALS_MAX, `grid values with ${decimals} decimals`);
  reader.require(count);
  const integers = new Float64Array(count);
  for (let i = 0; i < count; i++) {
    const coded = reader.varint();
    const difference = coded % 2 === 0 ? coded / 2 : -(coded + 1) / 2;
    integers[i] = expected(integers, i, shape) + difference;
    reader.check(Math.abs(integers[i]) <= INTEGER_MAX, "a grid value that is too large");
  }
  return Float32Array.from(integers, (integer) => integer / 10 ** decimals);
}

function decimalCode(values: Float32Array, shape: Shape): Uint8Array | undefined {
  const integers = new Float64Array(values.length);
  for (let decimals = 0; decimals <= DECIMALS_MAX; decimals++) {
    if (!toIntegers(values, decimals, integers)) continue;
    const writer = new ByteWriter();
    writer.u8(DECIMAL);
    writer.u8(decimals);
    for (let i = 0; i < integers.length; i++) {
      const difference = integers[i] - expected(integers, i, shape);
      writer.varint(difference >= 0 ? 2 * difference : -2 * difference - 1);
    }
    return writer.finish();
  }
  return undefined;
}

/** Whether every value is the float32 nearest to an integer · 10^−decimals, signs of zero included. */
function toIntegers(values: Float32Array, decimals: number, out: Float64Array): boolean {
  const power = 10 ** decimals;
  for (let i = 0; i < values.length; i++) {
    const integer = Math.round(values[i] * power);
    if (!(Math.abs(integer) <= INTEGER_MAX) || !Object.is(Math.fround(integer / power), values[i]))
      return false;
    out[i] = integer;
  }
  return true;
}

/** A node as its western, southern and south-western neighbours let expect: continued as a plane, or as a line. */
function expected(integers: Float64Array, i: number, { columns, rows }: Shape): number {
  const column = i % columns;
  const row = Math.floor(i / columns) % rows;
  if (column === 0) return row === 0 ? 0 : integers[i - columns];
  if (row === 0) return integers[i - 1];
  return integers[i - 1] + integers[i - columns] - integers[i - columns - 1];
}
