import type { Scan } from "../core/core.js";

/** One attribute of a record. */
export interface Field {
  readonly name: string;
  /** The number of one record. */
  read(view: DataView, record: number): number;
}

type Reader = (view: DataView, at: number) => number;

const u8: Reader = (view, at) => view.getUint8(at);
const u16: Reader = (view, at) => view.getUint16(at, true);
const i16: Reader = (view, at) => view.getInt16(at, true);
const i32: Reader = (view, at) => view.getInt32(at, true);
const f64: Reader = (view, at) => view.getFloat64(at, true);

/** Readers and sizes of the data types of extra bytes, by their names (LAS 1.4 R15, table 24). */
const TYPES: ReadonlyMap<string, readonly [Reader, number]> = new Map(
  Object.entries<readonly [Reader, number]>({
    uint8: [u8, 1],
    int8: [(view, at) => view.getInt8(at), 1],
    uint16: [u16, 2],
    int16: [i16, 2],
    uint32: [(view, at) => view.getUint32(at, true), 4],
    int32: [i32, 4],
    uint64: [(view, at) => Number(view.getBigUint64(at, true)), 8],
    int64: [(view, at) => Number(view.getBigInt64(at, true)), 8],
    float32: [(view, at) => view.getFloat32(at, true), 4],
    float64: [f64, 8],
  }),
);

/** Bytes of a record without extra bytes, by point format. */
export const BASE_LENGTH = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67];

/** Where the GPS time and the colours stand in the formats that have them. */
const GPS_TIME: Readonly<Record<number, number>> = { 1: 20, 3: 20, 4: 20, 5: 20 };
const COLOURS: Readonly<Record<number, number>> = { 2: 20, 3: 28, 5: 28, 7: 30, 8: 30, 10: 30 };
const DEGREES_PER_UNIT = 0.006;

/**
 * The attributes of a file's records under the names of the statistics record (docs/record.md), coordinates in source
 * units, scan angles in degrees, extra bytes as they are stored.
 */
export function fields({ pointFormat, recordLength, scale, offset, extraBytes }: Scan): Field[] {
  const field = (name: string, at: number, reader: Reader, map = (value: number) => value): Field => ({
    name,
    read: (view, record) => map(reader(view, record * recordLength + at)),
  });
  const all = ["x", "y", "z"].map((name, axis) =>
    field(name, 4 * axis, i32, (value) => value * scale[axis]! + offset[axis]!),
  );
  all.push(field("intensity", 12, u16), ...(pointFormat < 6 ? legacy(field) : extended(field)));
  const time = pointFormat < 6 ? GPS_TIME[pointFormat] : 22;
  if (time !== undefined) all.push(field("gpsTime", time, f64));
  const colours = COLOURS[pointFormat];
  if (colours !== undefined) {
    for (const [index, name] of ["red", "green", "blue"].entries())
      all.push(field(name, colours + 2 * index, u16));
  }
  if (pointFormat === 8 || pointFormat === 10) all.push(field("nir", 36, u16));
  let at = BASE_LENGTH[pointFormat] ?? recordLength;
  for (const { name, type } of extraBytes) {
    const [, base, count] = /^(\w+?)(?:\[(\d+)\])?$/.exec(type) ?? [];
    const known = TYPES.get(base ?? "");
    const size = (known?.[1] ?? 1) * Number(count ?? 1);
    if (at + size > recordLength) break;
    if (known && count === undefined) all.push(field(name, at, known[0]));
    at += size;
  }
  return all;
}

type Make = (name: string, at: number, reader: Reader, map?: (value: number) => number) => Field;

/** Point formats 0 to 5. */
function legacy(field: Make): Field[] {
  return [
    field("returnNumber", 14, u8, (value) => value & 7),
    field("numberOfReturns", 14, u8, (value) => (value >> 3) & 7),
    field("classification", 15, u8, (value) => value & 31),
    field("userData", 17, u8),
    field("scanAngle", 16, (view, at) => view.getInt8(at)),
    field("pointSourceId", 18, u16),
  ];
}

/** Point formats 6 to 10. */
function extended(field: Make): Field[] {
  return [
    field("returnNumber", 14, u8, (value) => value & 15),
    field("numberOfReturns", 14, u8, (value) => value >> 4),
    field("classification", 16, u8),
    field("userData", 17, u8),
    field("scanAngle", 18, i16, (value) => value * DEGREES_PER_UNIT),
    field("pointSourceId", 20, u16),
  ];
}
