import type { RecordLayout } from "../laz/index.js";
import type { ByteSink } from "./byte-sink.js";
import type { PointCompressor } from "./compressor/laz-worker.js";
import type { LasBody } from "./las-body.js";
import { HEADER } from "./las-file.js";

/** Points of a chunk, as LASzip and the converter's core have it. */
const CHUNK = 50_000;

/** Bytes before the chunks, which say where the chunk table is. */
const TABLE_PLACE = 8;

/** Bit of the point format that says that points are compressed. */
const COMPRESSED = 0x80;

/** Bytes of the header of a variable length record (LAS 1.4 R15, table 6), and where it has what. */
const RECORD = { header: 54, user: 2, id: 18, length: 20, description: 22 } as const;

/** Records as LAZ: chunks of 50,000 points, one being compressed while the next is filled; the bytes that the core writes. */
export class LazBody implements LasBody {
  readonly #sink: ByteSink;
  readonly #compressor: PointCompressor;
  readonly #layout: RecordLayout;
  /** The record of LASzip, header and content. */
  readonly #record: Uint8Array;
  readonly #lengths: number[] = [];
  #chunk: Uint8Array<ArrayBuffer>;
  #filled = 0;
  #compressing: Promise<Uint8Array> | undefined;
  /** Where the points begin, and where the next byte goes. */
  #begin = 0;
  #at = 0;

  private constructor(
    sink: ByteSink,
    compressor: PointCompressor,
    layout: RecordLayout & { readonly length: number },
    content: Uint8Array,
  ) {
    [this.#sink, this.#compressor, this.#layout] = [sink, compressor, layout];
    this.#record = laszipRecord(content);
    this.#chunk = new Uint8Array(CHUNK * layout.length);
  }

  /** @throws what the compressor throws */
  static async begin(
    sink: ByteSink,
    compressor: PointCompressor,
    layout: RecordLayout & { readonly length: number },
  ): Promise<LazBody> {
    const content = await compressor.run("describe", layout, new Uint8Array(0));
    return new LazBody(sink, compressor, layout, content);
  }

  front(plain: Uint8Array): Uint8Array {
    const front = new Uint8Array(plain.length + this.#record.length);
    front.set(plain);
    front.set(this.#record, plain.length);
    const view = new DataView(front.buffer);
    view.setUint32(HEADER.pointsOffset, front.length, true);
    view.setUint32(HEADER.recordCount, view.getUint32(HEADER.recordCount, true) + 1, true);
    view.setUint8(HEADER.format, view.getUint8(HEADER.format) | COMPRESSED);
    const behind = view.getUint32(HEADER.extendedCount, true) > 0;
    view.setBigUint64(HEADER.extendedOffset, behind ? BigInt(this.#at) : 0n, true);
    if (this.#begin === 0) this.#begin = front.length;
    return front;
  }

  async take(records: Uint8Array<ArrayBuffer>): Promise<void> {
    if (this.#at === 0) await this.#write(new Uint8Array(TABLE_PLACE));
    for (let from = 0; from < records.length; ) {
      const part = records.subarray(from, from + this.#chunk.length - this.#filled);
      this.#chunk.set(part, this.#filled);
      this.#filled += part.length;
      from += part.length;
      if (this.#filled === this.#chunk.length) await this.#compress(this.#chunk.length);
    }
  }

  async end(): Promise<void> {
    if (this.#at === 0) await this.#write(new Uint8Array(TABLE_PLACE));
    if (this.#filled > 0) await this.#compress(0);
    await this.#settle();
    const place = new DataView(new ArrayBuffer(TABLE_PLACE));
    place.setBigUint64(0, BigInt(this.#at), true);
    const lengths = new DataView(new ArrayBuffer(4 * this.#lengths.length));
    for (const [index, length] of this.#lengths.entries()) lengths.setUint32(4 * index, length, true);
    await this.#write(await this.#compressor.run("table", this.#layout, new Uint8Array(lengths.buffer)));
    await this.#sink.overwrite(this.#begin, new Uint8Array(place.buffer));
  }

  /** Has the chunk compressed once the one before is written. @param next bytes of the chunk that is filled then */
  async #compress(next: number): Promise<void> {
    const full = this.#chunk.slice(0, this.#filled);
    await this.#settle();
    this.#compressing = this.#compressor.run("compress", this.#layout, full);
    // Whoever waits for it hears of its failure.
    this.#compressing.catch(() => undefined);
    if (next === 0) this.#chunk = new Uint8Array(0);
    this.#filled = 0;
  }

  async #settle(): Promise<void> {
    if (!this.#compressing) return;
    const bytes = await this.#compressing;
    this.#compressing = undefined;
    this.#lengths.push(bytes.length);
    await this.#write(bytes);
  }

  async #write(bytes: Uint8Array): Promise<void> {
    if (this.#at === 0) this.#at = this.#begin;
    await this.#sink.write(bytes);
    this.#at += bytes.length;
  }
}

function laszipRecord(content: Uint8Array): Uint8Array {
  const bytes = new Uint8Array(RECORD.header + content.length);
  const view = new DataView(bytes.buffer);
  const put = (text: string, at: number) => bytes.set(new TextEncoder().encode(text), at);
  put("laszip encoded", RECORD.user);
  view.setUint16(RECORD.id, 22204, true);
  view.setUint16(RECORD.length, content.length, true);
  put("https://laszip.org", RECORD.description);
  bytes.set(content, RECORD.header);
  return bytes;
}
