import type { ExtraBytes } from "../sources/las/extra-bytes.js";
import { recordFields } from "../sources/las/record-fields.js";
import { type StoredAttribute, sizeOf } from "./stored-attribute.js";

/** Bytes of records of formats 6, 7 and 8 without extra bytes. */
const BASE: Readonly<Record<number, number>> = { 6: 30, 7: 36, 8: 38 };

/** Extra bytes one after the other; the least that a descriptor says. */
export function extraBytes(
  ...list: readonly (Pick<ExtraBytes, "name" | "type"> & Partial<ExtraBytes>)[]
): ExtraBytes[] {
  let at = 0;
  return list.map((given) => {
    const extra: ExtraBytes = {
      ...{ description: "", components: 1, scale: [1, 1, 1], offset: [0, 0, 0], noData: undefined, at },
      ...given,
    };
    at += sizeOf(extra.type) * extra.components;
    return extra;
  });
}

/** Plain records of random bytes but for coordinates in [0, 1000), with the attributes that they hold. */
export function randomRecords(
  pointFormat: number,
  count: number,
  extra: readonly ExtraBytes[],
  next: () => number,
) {
  const fields = recordFields(pointFormat, extra);
  const length = extra.reduce(
    (sum, { type, components }) => sum + sizeOf(type) * components,
    BASE[pointFormat],
  );
  const bytes = Uint8Array.from({ length: count * length }, () => next() * 256);
  const view = new DataView(bytes.buffer);
  for (let at = 0; at < bytes.length; at += length) {
    for (let axis = 0; axis < 3; axis++) view.setInt32(at + 4 * axis, next() * 1000, true);
    // Seconds of a year, as GPS counts them; random bytes would be numbers of all sizes.
    view.setFloat64(at + 22, 3e8 + next() * 3e7, true);
    for (const field of fields) {
      if (field.at >= BASE[pointFormat] && field.type === "float64")
        view.setFloat64(at + field.at, next() * 1e6 - 5e5, true);
    }
  }
  const attributes: StoredAttribute[] = fields.map((field) => ({ ...field, bytes, stride: length }));
  return { bytes, view, attributes, recordLength: length, count };
}

/** Numbers in [0, 1) that are the same in each run (G. Marsaglia, xorshift32, 2003). */
export function randomNumbers(seed: number): () => number {
  let state = seed | 0 || 1;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) / 2 ** 32;
  };
}
