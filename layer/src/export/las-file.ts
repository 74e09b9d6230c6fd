import { takeName } from "../sources/contract/point-attribute.js";
import type { LasEnvelope, LasVariableRecord } from "../sources/contract/point-source.js";

/** Where the fields of the public header block stand that follow from the points (LAS 1.4 R15, table 3). */
export const HEADER = {
  ...{ software: 58, size: 94, pointsOffset: 96, recordCount: 100, format: 104, recordLength: 105 },
  ...{ legacyCount: 107, legacyReturns: 111, bounds: 179, waveforms: 227, extendedOffset: 235 },
  ...{ extendedCount: 243, count: 247, returns: 255, end: 375 },
} as const;

/** Returns that are counted. */
const RETURNS = 15;

/** Bytes of a descriptor of extra bytes (LAS 1.4 R15, table 24). */
const DESCRIPTOR = 192;

/** Data type `double` of such a descriptor, and the one of bytes that are not described. */
const DOUBLE = 10;
const UNDESCRIBED = 0;

/** What stands in the header's field for the software that wrote the file. */
const SOFTWARE = "Groma";

/** An attribute that the exported records get behind their own bytes, a float64. */
export interface AddedAttribute {
  /** At most 30 bytes of UTF-8; gets a number where an attribute of the source has it. */
  readonly name: string;
  /** At most 32 bytes of UTF-8. */
  readonly description: string;
}

/** What is known of a file once all its points are. */
export interface PointSummary {
  readonly count: number;
  /** Points of the return numbers 1 to 15. */
  readonly returns: ArrayLike<number>;
  /** Least x, y, z, then greatest, source coordinates; of no meaning without points. */
  readonly bounds: ArrayLike<number>;
}

/** Everything of a LAS 1.4 file but its points. */
export class LasFrame {
  /** Bytes per record, added attributes included. */
  readonly recordLength: number;
  readonly #envelope: LasEnvelope;
  readonly #records: readonly LasVariableRecord[];
  #front: Uint8Array | undefined;

  /**
   * @param baseLength bytes of a record without extra bytes
   * @param added attributes behind those of the source
   */
  constructor(envelope: LasEnvelope, baseLength: number, added: readonly AddedAttribute[]) {
    this.#envelope = envelope;
    this.recordLength = envelope.recordLength + 8 * added.length;
    this.#records =
      added.length === 0
        ? envelope.records
        : withDescriptors(envelope, envelope.recordLength - baseLength, added);
  }

  /** Header and records before the points; the same bytes each time, with what follows from the points put in anew. */
  front(points: PointSummary): Uint8Array {
    this.#front ??= this.#before();
    this.#fill(new DataView(this.#front.buffer), this.#front, points);
    return this.#front;
  }

  #before(): Uint8Array {
    const before = this.#records.filter(({ extended }) => !extended);
    const head = this.#envelope.header;
    const bytes = new Uint8Array(before.reduce((sum, record) => sum + lengthOf(record), head.length));
    bytes.set(head);
    putRecords(bytes, head.length, before);
    new DataView(bytes.buffer).setUint32(HEADER.recordCount, before.length, true);
    return bytes;
  }

  /** Records behind the points. */
  back(): Uint8Array {
    const behind = this.#behind();
    const bytes = new Uint8Array(behind.reduce((sum, record) => sum + lengthOf(record), 0));
    putRecords(bytes, 0, behind);
    return bytes;
  }

  #behind(): readonly LasVariableRecord[] {
    return this.#records.filter(({ extended }) => extended);
  }

  #fill(view: DataView, bytes: Uint8Array, { count, returns, bounds }: PointSummary): void {
    const { pointFormat } = this.#envelope;
    const extended = this.#behind().length;
    bytes.fill(0, HEADER.software, HEADER.software + 32);
    bytes.set(new TextEncoder().encode(SOFTWARE), HEADER.software);
    view.setUint32(HEADER.pointsOffset, bytes.length, true);
    view.setUint8(HEADER.format, pointFormat);
    view.setUint16(HEADER.recordLength, this.recordLength, true);
    // The counts of LAS 1.3 and before have to be 0 for the formats from 6 on.
    bytes.fill(0, HEADER.legacyCount, HEADER.legacyReturns + 20);
    for (let axis = 0; axis < 3; axis++) {
      const [least, greatest] = count > 0 ? [bounds[axis], bounds[axis + 3]] : [0, 0];
      view.setFloat64(HEADER.bounds + 16 * axis, greatest, true);
      view.setFloat64(HEADER.bounds + 16 * axis + 8, least, true);
    }
    setCount(view, HEADER.waveforms, 0);
    const end = bytes.length + count * this.recordLength;
    setCount(view, HEADER.extendedOffset, extended > 0 ? end : 0);
    view.setUint32(HEADER.extendedCount, extended, true);
    setCount(view, HEADER.count, count);
    for (let number = 1; number <= RETURNS; number++)
      setCount(view, HEADER.returns + 8 * (number - 1), returns[number]);
  }
}

/** Frames of files that are written one after the other: those of the same records share one. */
export class LasFrames {
  #envelope: LasEnvelope | undefined;
  #added: readonly AddedAttribute[] | undefined;
  #frame: LasFrame | undefined;

  /** @param baseLength bytes of a record without extra bytes @param added attributes behind those of the source */
  of(envelope: LasEnvelope, baseLength: number, added: readonly AddedAttribute[]): LasFrame {
    if (!this.#frame || this.#envelope !== envelope || this.#added !== added)
      this.#frame = new LasFrame(envelope, baseLength, added);
    this.#envelope = envelope;
    this.#added = added;
    return this.#frame;
  }
}

/** A whole number below 2⁵³ as one of 64 bits. */
function setCount(view: DataView, at: number, value: number): void {
  view.setUint32(at, value % 2 ** 32, true);
  view.setUint32(at + 4, Math.floor(value / 2 ** 32), true);
}

function lengthOf({ header, content }: LasVariableRecord): number {
  return header.length + content.length;
}

function putRecords(bytes: Uint8Array, from: number, records: readonly LasVariableRecord[]): void {
  let at = from;
  for (const { header, content } of records) {
    bytes.set(header, at);
    bytes.set(content, at + header.length);
    at += header.length + content.length;
  }
}

/** The records with descriptors of further attributes; bytes that nobody described get one that says so. */
function withDescriptors(
  { records }: LasEnvelope,
  extraLength: number,
  added: readonly AddedAttribute[],
): readonly LasVariableRecord[] {
  const present = records.find(({ userId, recordId }) => userId === "LASF_Spec" && recordId === 4);
  const known = present
    ? wholeDescriptors(present.content, extraLength)
    : { bytes: new Uint8Array(0), length: 0 };
  const rest = extraLength - known.length;
  const gaps = Array.from({ length: Math.ceil(rest / 255) }, (_, index) => Math.min(255, rest - 255 * index));
  const taken = new Set(namesOf(known.bytes));
  const descriptors = [
    ...gaps.map((length) => descriptor(UNDESCRIBED, length, "", "")),
    ...added.map(({ name, description }) => descriptor(DOUBLE, 0, takeName(name, taken), description)),
  ];
  const content = new Uint8Array(known.bytes.length + DESCRIPTOR * descriptors.length);
  content.set(known.bytes);
  for (const [index, bytes] of descriptors.entries())
    content.set(bytes, known.bytes.length + DESCRIPTOR * index);
  const record = extraBytesRecord(present, content);
  return present ? records.map((one) => (one === present ? record : one)) : [...records, record];
}

/** Sizes of the data types 1 to 10. */
const SIZES = [1, 1, 2, 2, 4, 4, 8, 8, 4, 8];

/** The descriptors of bytes that are there, and how many bytes these describe. */
function wholeDescriptors(content: Uint8Array, available: number): { bytes: Uint8Array; length: number } {
  let [from, length] = [0, 0];
  for (; from + DESCRIPTOR <= content.length; from += DESCRIPTOR) {
    const type = content[from + 2];
    if (type > 30) break;
    const size = type === 0 ? content[from + 3] : SIZES[(type - 1) % 10] * (Math.floor((type - 1) / 10) + 1);
    if (length + size > available) break;
    length += size;
  }
  return { bytes: content.subarray(0, from), length };
}

/** Names in descriptors. */
function namesOf(descriptors: Uint8Array): string[] {
  return Array.from({ length: descriptors.length / DESCRIPTOR }, (_, index) => {
    const name = descriptors.subarray(DESCRIPTOR * index + 4, DESCRIPTOR * index + 36);
    const end = name.indexOf(0);
    return new TextDecoder().decode(end < 0 ? name : name.subarray(0, end));
  });
}

function descriptor(type: number, options: number, name: string, description: string): Uint8Array {
  const bytes = new Uint8Array(DESCRIPTOR);
  bytes[2] = type;
  bytes[3] = options;
  new TextEncoder().encodeInto(name, bytes.subarray(4, 36));
  new TextEncoder().encodeInto(description, bytes.subarray(160, 192));
  return bytes;
}

function extraBytesRecord(present: LasVariableRecord | undefined, content: Uint8Array): LasVariableRecord {
  const extended = present?.extended ?? false;
  const header = present?.header.slice() ?? new Uint8Array(54);
  const view = new DataView(header.buffer);
  if (!present) {
    header.set(new TextEncoder().encode("LASF_Spec"), 2);
    view.setUint16(18, 4, true);
  }
  if (extended) view.setBigUint64(20, BigInt(content.length), true);
  else view.setUint16(20, content.length, true);
  return { userId: "LASF_Spec", recordId: 4, extended, header, content };
}
