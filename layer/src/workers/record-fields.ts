import { BASE_RECORD_LENGTH, type ExtraBytes, type NumberType } from "../sources/index.js";

/** One attribute in a record of point format 6, 7 or 8. */
export interface RecordField {
  readonly name: string;
  /** The writer's words about it; empty for the standard ones. */
  readonly description: string;
  readonly type: NumberType;
  /** Byte in the record. */
  readonly at: number;
  /** Numbers of that type, one after the other. */
  readonly components: 1 | 2 | 3;
  /** The bits that count, after a shift to the right: several fields share a byte. */
  readonly shift: number;
  readonly mask: number;
  /** value = stored · scale + offset, per component. */
  readonly scale: readonly number[];
  readonly offset: readonly number[];
  /** The stored number that means "no value". */
  readonly noData: number | bigint | undefined;
  readonly extra: boolean;
}

/** Degrees per step of the scan angle (LAS 1.4 R15, table 15). */
const SCAN_ANGLE_STEP = 0.006;

const field = (name: string, type: NumberType, at: number, rest: Partial<RecordField> = {}): RecordField => ({
  ...{ name, type, at, description: "", components: 1, shift: 0, mask: -1, extra: false, noData: undefined },
  ...{ scale: [1], offset: [0] },
  ...rest,
});

/** Attributes of all formats besides x, y and z (LAS 1.4 R15, table 15). */
const COMMON: readonly RecordField[] = [
  field("intensity", "uint16", 12),
  field("returnNumber", "uint8", 14, { mask: 15 }),
  field("numberOfReturns", "uint8", 14, { shift: 4, mask: 15 }),
  field("flags", "uint8", 15),
  field("classification", "uint8", 16),
  field("userData", "uint8", 17),
  field("scanAngle", "int16", 18, { scale: [SCAN_ANGLE_STEP] }),
  field("pointSourceId", "uint16", 20),
  field("gpsTime", "float64", 22),
];

/** Added in formats 7 and 8 (tables 16 and 17). */
const COLOURS: readonly RecordField[] = [
  field("red", "uint16", 30),
  field("green", "uint16", 32),
  field("blue", "uint16", 34),
];
const INFRARED = field("nir", "uint16", 36);

/** Names of columns that no field of the record has. */
const DERIVED = ["x", "y", "z", "color", "elevation", "ellipsoidalHeight"];

/**
 * The attributes of a record but for x, y and z: those of the point format, then the extra bytes. An extra attribute
 * without a name is called by its place, one whose name is taken gets a number.
 */
export function recordFields(pointFormat: number, extraBytes: readonly ExtraBytes[]): RecordField[] {
  const fields = [...COMMON];
  if (pointFormat >= 7) fields.push(...COLOURS);
  if (pointFormat >= 8) fields.push(INFRARED);
  const taken = new Set([...DERIVED, ...fields.map(({ name }) => name)]);
  extraBytes.forEach(({ name: given, at, ...rest }, index) => {
    const plain = given || `extra ${index + 1}`;
    let name = plain;
    for (let number = 2; taken.has(name); number++) name = `${plain} ${number}`;
    taken.add(name);
    fields.push({ ...rest, name, at: BASE_RECORD_LENGTH[pointFormat] + at, shift: 0, mask: -1, extra: true });
  });
  return fields;
}

/** Bytes of a number. */
export function sizeOf(type: NumberType): number {
  return type.endsWith("64") ? 8 : type.endsWith("32") ? 4 : type.endsWith("16") ? 2 : 1;
}

/** How a number of each type is read; 64-bit integers lose what float64 cannot hold. */
const READERS: Readonly<Record<NumberType, (view: DataView, at: number) => number>> = {
  uint8: (view, at) => view.getUint8(at),
  int8: (view, at) => view.getInt8(at),
  uint16: (view, at) => view.getUint16(at, true),
  int16: (view, at) => view.getInt16(at, true),
  uint32: (view, at) => view.getUint32(at, true),
  int32: (view, at) => view.getInt32(at, true),
  uint64: (view, at) => Number(view.getBigUint64(at, true)),
  int64: (view, at) => Number(view.getBigInt64(at, true)),
  float32: (view, at) => view.getFloat32(at, true),
  float64: (view, at) => view.getFloat64(at, true),
};

/** The reader of a type. */
export function readerOf(type: NumberType): (view: DataView, at: number) => number {
  return READERS[type];
}

/**
 * The exact value of one component: 64-bit integers that float64 cannot hold come as bigint where no scale or offset
 * applies; NaN stands for no value.
 * @param record byte of the record's start
 */
export function exactValue(
  view: DataView,
  record: number,
  from: RecordField,
  component: number,
): number | bigint {
  const { type, at, shift, mask, noData } = from;
  const place = record + at + component * sizeOf(type);
  const scale = from.scale[component] ?? 1;
  const offset = from.offset[component] ?? 0;
  if (type === "uint64" || type === "int64") {
    const whole = type === "uint64" ? view.getBigUint64(place, true) : view.getBigInt64(place, true);
    if (whole === noData) return Number.NaN;
    const plain = scale === 1 && offset === 0;
    return plain && !Number.isSafeInteger(Number(whole)) ? whole : Number(whole) * scale + offset;
  }
  const stored = READERS[type](view, place);
  if (stored === noData) return Number.NaN;
  return (mask === -1 ? stored : (stored >> shift) & mask) * scale + offset;
}
