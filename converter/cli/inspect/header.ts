import type { FileSource } from "../files/file-source.js";

/** What of a header the core does not tell (LAS 1.4 R15, table 3). */
export interface HeaderDetails {
  /** `week`: seconds of a GPS week; `standard`: seconds since 1980-01-06, less a thousand million. */
  readonly gpsTime: "week" | "standard";
  /** Points per return number, from 1, as the header counts them; empty where it does not. */
  readonly returns: readonly number[];
  /** First byte of the points. */
  readonly pointsOffset: number;
  readonly records: readonly RecordEntry[];
}

/** A variable length record, or an extended one behind the points. */
export interface RecordEntry {
  readonly userId: string;
  readonly recordId: number;
  readonly description: string;
  /** Bytes of its content. */
  readonly bytes: number;
  readonly extended: boolean;
  /** First byte of its content. */
  readonly begin: number;
}

const HEADER_LENGTH = 375;
/** Lengths of the headers of records (LAS 1.4 R15, tables 5 and 6). */
const RECORD_HEADER = { plain: 54, extended: 60 } as const;
/** More records than any writer makes; a count above it is damage. */
const MOST_RECORDS = 1000;

/** Reads what the header of a file that the core has read says besides; what is damaged is left out. */
export async function headerDetails(source: FileSource): Promise<HeaderDetails> {
  const bytes = new Uint8Array(HEADER_LENGTH);
  bytes.set(await source.upTo(0, HEADER_LENGTH));
  const view = new DataView(bytes.buffer);
  const is14 = view.getUint8(25) >= 4;
  const pointsOffset = view.getUint32(96, true);
  const returns = is14
    ? Array.from({ length: 15 }, (_, i) => Number(view.getBigUint64(255 + 8 * i, true)))
    : Array.from({ length: 5 }, (_, i) => view.getUint32(111 + 4 * i, true));
  const plain = await records(source, view.getUint16(94, true), view.getUint32(100, true), "plain");
  const extended = is14
    ? await records(source, Number(view.getBigUint64(235, true)), view.getUint32(243, true), "extended")
    : [];
  return {
    // LAS 1.2 gave the bit its meaning.
    gpsTime: view.getUint8(25) >= 2 && (view.getUint16(6, true) & 1) === 1 ? "standard" : "week",
    returns: returns.some((count) => count > 0) ? returns : [],
    pointsOffset,
    records: [...plain, ...extended],
  };
}

async function records(
  source: FileSource,
  first: number,
  count: number,
  kind: keyof typeof RECORD_HEADER,
): Promise<RecordEntry[]> {
  const length = RECORD_HEADER[kind];
  const found: RecordEntry[] = [];
  let at = first;
  for (let index = 0; index < Math.min(count, MOST_RECORDS); index++) {
    if (!(at > 0) || at + length > source.size) break;
    const bytes = await source.read(at, at + length);
    const view = new DataView(bytes.buffer, bytes.byteOffset);
    const size = kind === "plain" ? view.getUint16(20, true) : Number(view.getBigUint64(20, true));
    if (at + length + size > source.size) break;
    found.push({
      userId: text(bytes.subarray(2, 18)),
      recordId: view.getUint16(18, true),
      description: text(bytes.subarray(length - 32, length)),
      ...{ bytes: size, extended: kind === "extended", begin: at + length },
    });
    at += length + size;
  }
  return found;
}

function text(bytes: Uint8Array): string {
  const end = bytes.indexOf(0);
  return Buffer.from(end < 0 ? bytes : bytes.subarray(0, end))
    .toString("latin1")
    .trimEnd();
}
