import type { NumberType } from "../contract/point-attribute.js";
import { readText } from "./las-header.js";

/** One numeric attribute that is stored after the standard fields of a record. */
export interface ExtraBytes {
  readonly name: string;
  /** The writer's words about it; empty where there are none. */
  readonly description: string;
  readonly type: NumberType;
  /** More than 1 for the arrays that LAS 1.4 R14 deprecated. */
  readonly components: 1 | 2 | 3;
  /** Byte within the record's extra bytes. */
  readonly at: number;
  /** value = stored · scale + offset, per component. */
  readonly scale: readonly number[];
  readonly offset: readonly number[];
  /** The stored number that means "no value"; undefined where there is none. */
  readonly noData: number | bigint | undefined;
}

/** Bytes of one descriptor (LAS 1.4 R15, "Extra Bytes", user id `LASF_Spec`, record id 4). */
const DESCRIPTOR = 192;

/** Data types 1 to 10 of the descriptor, with their sizes in bytes. */
const TYPES: readonly (readonly [NumberType, number])[] = [
  ["uint8", 1],
  ["int8", 1],
  ["uint16", 2],
  ["int16", 2],
  ["uint32", 4],
  ["int32", 4],
  ["uint64", 8],
  ["int64", 8],
  ["float32", 4],
  ["float64", 8],
];

/** Bits of the descriptor's options. */
const HAS_NO_DATA = 1;
const HAS_SCALE = 8;
const HAS_OFFSET = 16;

/**
 * Reads the descriptors of extra bytes. Undocumented bytes (data type 0) are passed over; what would reach beyond the
 * record, or has a type that the standard does not know, ends the list, since nothing behind it can be found.
 * @param available extra bytes that a record really has
 */
export function parseExtraBytes(bytes: Uint8Array, available: number): ExtraBytes[] {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const found: ExtraBytes[] = [];
  let at = 0;
  for (let from = 0; from + DESCRIPTOR <= bytes.length; from += DESCRIPTOR) {
    const code = bytes[from + 2];
    const options = bytes[from + 3];
    if (code > 30) break;
    const [type, size] = code === 0 ? (["uint8", options] as const) : TYPES[(code - 1) % 10];
    const components = code === 0 ? 1 : Math.floor((code - 1) / 10) + 1;
    const end = at + size * components;
    if (end > available) break;
    if (code > 0) {
      found.push({
        name: readText(bytes, from + 4, 32),
        description: readText(bytes, from + 160, 32),
        ...{ type, components: components as 1 | 2 | 3, at },
        scale: threeOf(view, from + 112, (options & HAS_SCALE) !== 0, 1),
        offset: threeOf(view, from + 136, (options & HAS_OFFSET) !== 0, 0),
        noData: (options & HAS_NO_DATA) !== 0 ? noDataOf(view, from + 40, type) : undefined,
      });
    }
    at = end;
  }
  return found;
}

/** Three float64, or the default where they are not declared or not finite. */
function threeOf(view: DataView, at: number, declared: boolean, fallback: number): number[] {
  return [0, 8, 16].map((step) => {
    const value = declared ? view.getFloat64(at + step, true) : fallback;
    return Number.isFinite(value) ? value : fallback;
  });
}

/** The no-data value: 8 bytes, as the widest number of the type's kind (LAS 1.4 R15, table 25, "anytype"). */
function noDataOf(view: DataView, at: number, type: NumberType): number | bigint {
  if (type.startsWith("float")) return view.getFloat64(at, true);
  const value = type.startsWith("u") ? view.getBigUint64(at, true) : view.getBigInt64(at, true);
  return type.endsWith("64") ? value : Number(value);
}
