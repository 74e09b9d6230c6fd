/** Offsets in a record of point formats 6, 7 and 8 (LAS 1.4 R15, tables 15 to 17). */
const INTENSITY = 12;
const RED = 30;

/** The attributes of a chunk that are drawn, as recorded. */
export interface Records {
  readonly count: number;
  /** x, y, z of each point as LAS integers. */
  readonly xyz: Int32Array;
  readonly intensity: Uint16Array;
  /** Red, green, blue of each point; undefined in format 6. */
  readonly rgb: Uint16Array | undefined;
}

/** Takes the drawn attributes out of plain records. */
export function readRecords(bytes: Uint8Array, pointFormat: number, recordLength: number): Records {
  const count = bytes.length / recordLength;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const xyz = new Int32Array(3 * count);
  const intensity = new Uint16Array(count);
  const rgb = pointFormat === 6 ? undefined : new Uint16Array(3 * count);
  for (let point = 0, at = 0; point < count; point++, at += recordLength) {
    xyz[3 * point] = view.getInt32(at, true);
    xyz[3 * point + 1] = view.getInt32(at + 4, true);
    xyz[3 * point + 2] = view.getInt32(at + 8, true);
    intensity[point] = view.getUint16(at + INTENSITY, true);
    if (!rgb) continue;
    rgb[3 * point] = view.getUint16(at + RED, true);
    rgb[3 * point + 1] = view.getUint16(at + RED + 2, true);
    rgb[3 * point + 2] = view.getUint16(at + RED + 4, true);
  }
  return { count, xyz, intensity, rgb };
}

/** Least and greatest LAS integer per axis: min x, y, z, max x, y, z. */
export function integerBox({ xyz, count }: Pick<Records, "xyz" | "count">): Int32Array {
  const box = Int32Array.of(2147483647, 2147483647, 2147483647, -2147483648, -2147483648, -2147483648);
  for (let at = 0; at < 3 * count; at += 3) {
    for (let axis = 0; axis < 3; axis++) {
      const value = xyz[at + axis];
      if (value < box[axis]) box[axis] = value;
      if (value > box[axis + 3]) box[axis + 3] = value;
    }
  }
  return box;
}

/** Least and greatest of the values; 0 and 0 where there are none. */
export function valueRange(values: Uint16Array | undefined): { readonly min: number; readonly max: number } {
  if (!values || values.length === 0) return { min: 0, max: 0 };
  let min = 65535;
  let max = 0;
  for (const value of values) {
    if (value < min) min = value;
    if (value > max) max = value;
  }
  return { min, max };
}
