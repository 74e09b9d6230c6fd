/** What a {@link tinyCopc} is made with; the defaults make a well-formed file. */
export interface TinyCopc {
  readonly magic?: string;
  readonly minor?: number;
  readonly formatByte?: number;
  readonly recordLength?: number;
  readonly points?: number;
  readonly scale?: number;
  readonly wkt?: string;
  /** Least x, y, z and greatest x, y, z that the header declares; the octree's cube is (0, 0, 0) to (100, 100, 100). */
  readonly bounds?: readonly number[];
  /** Records besides COPC's own and the WKT: user id, record id, content. */
  readonly records?: readonly (readonly [string, number, Uint8Array])[];
  /** Extended records at the end: user id, record id, content, and the length that is claimed if not the true one. */
  readonly extended?: readonly (readonly [string, number, Uint8Array, number?])[];
  /** An extended record between points and root page, where `groma` puts checksums for which there is no room in front. */
  readonly ahead?: readonly [string, number, Uint8Array];
  /** Rows of the root page: depth, x, y, z, offset, length, points. An offset of 0 stands for the points' own. */
  readonly page?: readonly (readonly number[])[];
  /** Put instead of the true offset of the root page. */
  readonly pageOffset?: number;
}

/** One point at the origin's cube: enough for a reader that never decodes. */
const CHUNK = new Uint8Array(100);

/** Bytes of a hierarchy page. */
export function pageBytes(rows: readonly (readonly number[])[]): Uint8Array {
  const bytes = new Uint8Array(32 * rows.length);
  const view = new DataView(bytes.buffer);
  rows.forEach(([depth, x, y, z, offset, length, points], row) => {
    const at = 32 * row;
    for (const [index, value] of [depth, x, y, z].entries()) view.setInt32(at + 4 * index, value, true);
    view.setBigUint64(at + 16, BigInt(offset), true);
    view.setInt32(at + 24, length, true);
    view.setInt32(at + 28, points, true);
  });
  return bytes;
}

/** Extended records one after the other, as they stand at the end of a file. */
function extendedBytes(records: NonNullable<TinyCopc["extended"]>): Uint8Array {
  const bytes = new Uint8Array(records.reduce((sum, [, , content]) => sum + 60 + content.length, 0));
  const view = new DataView(bytes.buffer);
  let at = 0;
  for (const [user, id, content, claimed = content.length] of records) {
    bytes.set(new TextEncoder().encode(user), at + 2);
    view.setUint16(at + 18, id, true);
    view.setBigUint64(at + 20, BigInt(claimed), true);
    bytes.set(content, at + 60);
    at += 60 + content.length;
  }
  return bytes;
}

/** A COPC file of a few hundred bytes: header, records, a chunk of zeros and a root page. */
export function tinyCopc(options: TinyCopc = {}): Uint8Array {
  const {
    magic = "LASF",
    minor = 4,
    formatByte = 0x87,
    recordLength = 36,
    points = 10,
    scale = 0.01,
  } = options;
  const encoder = new TextEncoder();
  const records: [string, number, Uint8Array][] = [["copc", 1, new Uint8Array(160)]];
  if (options.wkt) records.push(["LASF_Projection", 2112, encoder.encode(`${options.wkt}\0`)]);
  for (const [user, id, content] of options.records ?? []) records.push([user, id, content]);
  const pointsOffset = 375 + records.reduce((sum, [, , content]) => sum + 54 + content.length, 0);
  const rows = (options.page ?? [[0, 0, 0, 0, 0, CHUNK.length, points]]).map(
    ([depth, x, y, z, offset, length, count]) => [depth, x, y, z, offset || pointsOffset, length, count],
  );
  const page = pageBytes(rows);
  const ahead = options.ahead ? extendedBytes([options.ahead]) : new Uint8Array();
  const pageOffset = pointsOffset + CHUNK.length + ahead.length;
  // A hierarchy is an extended record in real files; here an empty one stands for it.
  const extended = options.extended
    ? extendedBytes([["copc", 1000, new Uint8Array()], ...options.extended])
    : new Uint8Array();
  const file = new Uint8Array(pageOffset + page.length + extended.length);
  const view = new DataView(file.buffer);
  file.set(encoder.encode(magic), 0);
  view.setUint8(24, 1);
  view.setUint8(25, minor);
  view.setUint16(94, 375, true);
  view.setUint32(96, pointsOffset, true);
  view.setUint32(100, records.length, true);
  view.setUint8(104, formatByte);
  view.setUint16(105, recordLength, true);
  for (const at of [131, 139, 147]) view.setFloat64(at, scale, true);
  const bounds = options.bounds ?? [0, 0, 0, 100, 100, 50];
  for (const [index, at] of [187, 203, 219, 179, 195, 211].entries())
    view.setFloat64(at, bounds[index], true);
  view.setBigUint64(247, BigInt(points), true);
  let at = 375;
  for (const [user, id, content] of records) {
    file.set(encoder.encode(user), at + 2);
    view.setUint16(at + 18, id, true);
    view.setUint16(at + 20, content.length, true);
    file.set(content, at + 54);
    at += 54 + content.length;
  }
  for (const [index, value] of [50, 50, 50, 50, 1].entries()) view.setFloat64(429 + 8 * index, value, true);
  view.setBigUint64(469, BigInt(options.pageOffset ?? pageOffset), true);
  view.setBigUint64(477, BigInt(page.length), true);
  file.set(ahead, pointsOffset + CHUNK.length);
  if (options.ahead) {
    view.setBigUint64(235, BigInt(pointsOffset + CHUNK.length), true);
    view.setUint32(243, 1, true);
  }
  file.set(page, pageOffset);
  if (options.extended) {
    view.setBigUint64(235, BigInt(pageOffset + page.length), true);
    view.setUint32(243, options.extended.length + 1, true);
    file.set(extended, pageOffset + page.length);
  }
  return file;
}
