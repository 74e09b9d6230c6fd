import type { NumberType, PointAttribute } from "../sources/contract/point-attribute.js";

/** One attribute of decoded points: where its numbers are. Many attributes may share bytes, as those of records do. */
export interface StoredAttribute extends PointAttribute {
  readonly bytes: Uint8Array;
  /** Byte of the first point's number. */
  readonly at: number;
  /** Bytes from one point's number to the next one's. */
  readonly stride: number;
  /** The bits that count, after a shift to the right; 0 and -1 where all do. */
  readonly shift: number;
  readonly mask: number;
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
 */
export function exactValue(from: StoredAttribute, point: number, component: number): number | bigint {
  const { bytes, type, at, stride, shift, mask, noData } = from;
  const view = viewOf(bytes);
  const place = at + point * stride + component * sizeOf(type);
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

/**
 * Reads the first component of a point in its unit, as float64: {@link exactValue} for loops, which makes nothing for a point.
 * NaN stands for no value.
 */
export function valueReader(from: StoredAttribute): (point: number) => number {
  const { bytes, type, at, stride, shift, mask } = from;
  const [view, read] = [viewOf(bytes), READERS[type]];
  const noData = from.noData === undefined ? undefined : Number(from.noData);
  const [scale, offset] = [from.scale[0] ?? 1, from.offset[0] ?? 0];
  return (point) => {
    const stored = read(view, at + point * stride);
    if (stored === noData) return Number.NaN;
    return (mask === -1 ? stored : (stored >> shift) & mask) * scale + offset;
  };
}

/** A view to read numbers by. */
export function viewOf(bytes: Uint8Array): DataView {
  return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
}
