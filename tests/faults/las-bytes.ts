/** Bytes of a LAS 1.4 header, and of a record of format 6. */
const HEADER = 375;
const RECORD = 30;

/** A LAS 1.4 file of so many points of format 6 without order in a box of 1 km, the same at every call. */
export function lasOf(points: number): Uint8Array {
  const bytes = new Uint8Array(HEADER + points * RECORD);
  const view = new DataView(bytes.buffer);
  bytes.set(new TextEncoder().encode("LASF"));
  view.setUint16(6, 0x10, true);
  bytes.set([1, 4], 24);
  view.setUint16(94, HEADER, true);
  view.setUint32(96, HEADER, true);
  bytes[104] = 6;
  view.setUint16(105, RECORD, true);
  for (const axis of [0, 1, 2]) {
    view.setFloat64(131 + 8 * axis, 0.001, true);
    view.setFloat64(179 + 16 * axis, axis === 2 ? 50 : 1000, true);
  }
  view.setBigUint64(247, BigInt(points), true);
  let random = 1;
  const next = (below: number) => {
    random = (Math.imul(random, 1_664_525) + 1_013_904_223) >>> 0;
    return Math.floor((random / 2 ** 32) * below);
  };
  for (let at = HEADER; at < bytes.length; at += RECORD) {
    view.setInt32(at, next(1e6), true);
    view.setInt32(at + 4, next(1e6), true);
    view.setInt32(at + 8, next(50_000), true);
    view.setUint16(at + 12, next(65_536), true);
    bytes[at + 14] = 0x11;
    bytes[at + 16] = next(8);
    view.setFloat64(at + 22, (at - HEADER) / RECORD, true);
  }
  return bytes;
}
