import {
  DERIVED_COLUMNS,
  type NumberType,
  type PointAttribute,
  takeName,
} from "../contract/point-attribute.js";
import type { ExtraBytes } from "./extra-bytes.js";
import { BASE_RECORD_LENGTH } from "./las-header.js";

/** One attribute in a record of point format 6, 7 or 8. */
export interface RecordField extends PointAttribute {
  /** Byte in the record. */
  readonly at: number;
  /** The bits that count, after a shift to the right: several fields share a byte. */
  readonly shift: number;
  readonly mask: number;
}

/** Chunks of LAZ 1.4, each of records of one point format. */
export interface LazEncoding {
  readonly kind: "laz";
  /** Point data record format: 6, 7 or 8. */
  readonly pointFormat: number;
  /** Bytes per record, extra bytes included. */
  readonly recordLength: number;
  /** Bytes per record behind the standard fields, described or not. */
  readonly extraLength: number;
  /** Where a record has which attribute. */
  readonly fields: readonly RecordField[];
}

/** Degrees per step of the scan angle (LAS 1.4 R15, table 15). */
const SCAN_ANGLE_STEP = 0.006;

const field = (name: string, type: NumberType, at: number, rest: Partial<RecordField> = {}): RecordField => ({
  ...{
    name,
    type,
    at,
    description: "",
    kind: "scalar",
    components: 1,
    shift: 0,
    mask: -1,
    noData: undefined,
  },
  ...{ scale: [1], offset: [0] },
  ...rest,
});

/** Attributes of all formats besides x, y and z (LAS 1.4 R15, table 15). */
const COMMON: readonly RecordField[] = [
  field("intensity", "uint16", 12),
  field("returnNumber", "uint8", 14, { mask: 15 }),
  field("numberOfReturns", "uint8", 14, { shift: 4, mask: 15 }),
  field("flags", "uint8", 15, { kind: "flags" }),
  field("classification", "uint8", 16, { kind: "class" }),
  field("userData", "uint8", 17),
  field("scanAngle", "int16", 18, { scale: [SCAN_ANGLE_STEP], unit: "°" }),
  field("pointSourceId", "uint16", 20),
  field("gpsTime", "float64", 22, { unit: "s" }),
];

/** Added in formats 7 and 8 (tables 16 and 17). */
const COLOURS: readonly RecordField[] = [
  field("red", "uint16", 30),
  field("green", "uint16", 32),
  field("blue", "uint16", 34),
];
const INFRARED = field("nir", "uint16", 36);

/**
 * The attributes of a record but for x, y and z: those of the point format, then the extra bytes. An extra attribute
 * without a name is called by its place, one whose name is taken gets a number.
 */
export function recordFields(pointFormat: number, extraBytes: readonly ExtraBytes[]): RecordField[] {
  const fields = [...COMMON];
  if (pointFormat >= 7) fields.push(...COLOURS);
  if (pointFormat >= 8) fields.push(INFRARED);
  const taken = new Set([...DERIVED_COLUMNS, ...fields.map(({ name }) => name)]);
  extraBytes.forEach(({ name: given, at, ...rest }, index) => {
    const name = takeName(given || `extra ${index + 1}`, taken);
    const place = { at: BASE_RECORD_LENGTH[pointFormat] + at, shift: 0, mask: -1 };
    fields.push({ ...rest, ...place, name, kind: "scalar" });
  });
  return fields;
}
