import type { GeoTiffKeys } from "./crs.js";

/** Values of the keys by key id (OGC GeoTIFF 19-008r4, annex B). */
export type KeyValues = ReadonlyMap<number, number | string | readonly number[]>;

/** Where the values of a key are: in the entry itself, in the VLR of doubles, in that of text. */
const DOUBLES = 34736;
const ASCII = 34737;

/** The key directory as a map; entries that point outside their arrays, and empty ones, are passed over. */
export function readKeys({ directory, doubles, ascii }: GeoTiffKeys): KeyValues {
  const values = new Map<number, number | string | readonly number[]>();
  const stated = directory[3] ?? 0;
  for (let i = 0; i < stated && 8 + 4 * i <= directory.length; i++) {
    const [key, location, count, value] = directory.subarray(4 + 4 * i, 8 + 4 * i);
    if (key === 0) continue;
    if (location === 0) values.set(key, value);
    else if (location === DOUBLES && value + count <= doubles.length && count > 0) {
      values.set(key, count === 1 ? doubles[value] : Array.from(doubles.subarray(value, value + count)));
    } else if (location === ASCII) values.set(key, ascii.slice(value, value + count).replace(/[|\0]+$/, ""));
  }
  return values;
}
