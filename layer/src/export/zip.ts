/** What a ZIP archive says of one of its files. */
export interface ZipFile {
  readonly name: string;
  /** Where it begins in the archive: its first header. */
  readonly at: number;
  /** Bytes of its content, which is stored as it is. */
  readonly size: number;
  /** CRC-32 of its content. */
  readonly checksum: number;
}

/** Greatest numbers of fields of 32 and 16 bits: they say that the number itself stands in a wider field of ZIP64. */
const MOST = 0xffff_ffff;
const MOST_FILES = 0xffff;

/** Version 4.5, which has ZIP64, of Unix. */
const VERSION = 45;
const UNIX = 3 << 8;

/** Sizes and checksum stand behind the content; names are UTF-8 (APPNOTE 6.3.10, section 4.4.4). */
const FLAGS = 0x0808;

/** A plain file that its owner and the group may write. */
const MODE = 0o100664;

/** Time of day, then date, each 16 bits, local and to two seconds (4.4.6). */
function timeOf(date: Date): number {
  const time = (date.getHours() << 11) | (date.getMinutes() << 5) | (date.getSeconds() >> 1);
  const day = ((date.getFullYear() - 1980) << 9) | ((date.getMonth() + 1) << 5) | date.getDate();
  return ((day & 0xffff) << 16) | time;
}

/** What stands before the content of a file (4.3.7). */
export function zipHeader(name: string, date: Date): Uint8Array {
  const text = new TextEncoder().encode(name);
  const bytes = new Uint8Array(30 + text.length);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, 0x0403_4b50, true);
  view.setUint16(4, VERSION, true);
  view.setUint16(6, FLAGS, true);
  view.setUint32(10, timeOf(date), true);
  view.setUint16(26, text.length, true);
  bytes.set(text, 30);
  return bytes;
}

/** What stands behind the content of a file (4.3.9). */
export function zipDescriptor({ size, checksum }: Pick<ZipFile, "size" | "checksum">): Uint8Array {
  const wide = size >= MOST;
  const bytes = new Uint8Array(wide ? 24 : 16);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, 0x0807_4b50, true);
  view.setUint32(4, checksum, true);
  if (wide) {
    view.setBigUint64(8, BigInt(size), true);
    view.setBigUint64(16, BigInt(size), true);
  } else {
    view.setUint32(8, size, true);
    view.setUint32(12, size, true);
  }
  return bytes;
}

/**
 * What stands behind all files: a header of each (4.3.12), and where these are (4.3.14 to 4.3.16).
 * @param begin where that begins in the archive
 */
export function* zipDirectory(files: readonly ZipFile[], begin: number, date: Date): Generator<Uint8Array> {
  const time = timeOf(date);
  let end = begin;
  for (const file of files) {
    const bytes = directoryEntry(file, time);
    end += bytes.length;
    yield bytes;
  }
  const wide = files.length >= MOST_FILES || begin >= MOST || end - begin >= MOST;
  if (wide) yield wideEnd(files.length, begin, end);
  const bytes = new Uint8Array(22);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, 0x0605_4b50, true);
  view.setUint16(8, Math.min(MOST_FILES, files.length), true);
  view.setUint16(10, Math.min(MOST_FILES, files.length), true);
  view.setUint32(12, Math.min(MOST, end - begin), true);
  view.setUint32(16, Math.min(MOST, begin), true);
  yield bytes;
}

function directoryEntry({ name, at, size, checksum }: ZipFile, time: number): Uint8Array {
  const text = new TextEncoder().encode(name);
  // Numbers of ZIP64, of those only that have no room in fields of 32 bits (4.5.3).
  const wide = [...(size >= MOST ? [size, size] : []), ...(at >= MOST ? [at] : [])];
  const extra = wide.length > 0 ? 4 + 8 * wide.length : 0;
  const bytes = new Uint8Array(46 + text.length + extra);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, 0x0201_4b50, true);
  view.setUint16(4, VERSION | UNIX, true);
  view.setUint16(6, VERSION, true);
  view.setUint16(8, FLAGS, true);
  view.setUint32(12, time, true);
  view.setUint32(16, checksum, true);
  view.setUint32(20, Math.min(MOST, size), true);
  view.setUint32(24, Math.min(MOST, size), true);
  view.setUint16(28, text.length, true);
  view.setUint16(30, extra, true);
  view.setUint32(38, MODE << 16, true);
  view.setUint32(42, Math.min(MOST, at), true);
  bytes.set(text, 46);
  if (extra > 0) {
    const from = 46 + text.length;
    view.setUint16(from, 1, true);
    view.setUint16(from + 2, extra - 4, true);
    for (const [index, number] of wide.entries())
      view.setBigUint64(from + 4 + 8 * index, BigInt(number), true);
  }
  return bytes;
}

/** The end of a directory of ZIP64, and where that stands. */
function wideEnd(count: number, begin: number, end: number): Uint8Array {
  const bytes = new Uint8Array(56 + 20);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, 0x0606_4b50, true);
  view.setBigUint64(4, 44n, true);
  view.setUint16(12, VERSION | UNIX, true);
  view.setUint16(14, VERSION, true);
  view.setBigUint64(24, BigInt(count), true);
  view.setBigUint64(32, BigInt(count), true);
  view.setBigUint64(40, BigInt(end - begin), true);
  view.setBigUint64(48, BigInt(begin), true);
  view.setUint32(56, 0x0706_4b50, true);
  view.setBigUint64(64, BigInt(end), true);
  view.setUint32(72, 1, true);
  return bytes;
}
