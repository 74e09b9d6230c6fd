import { RecordError } from "../errors/errors.js";

/** Writes little-endian values one after the other. */
export class ByteWriter {
  private bytes = new Uint8Array(1024);
  private view = new DataView(this.bytes.buffer);
  private length = 0;

  u8(value: number): void {
    this.reserve(1);
    this.view.setUint8(this.length, value);
    this.length += 1;
  }

  u16(value: number): void {
    this.reserve(2);
    this.view.setUint16(this.length, value, true);
    this.length += 2;
  }

  u32(value: number): void {
    this.reserve(4);
    this.view.setUint32(this.length, value, true);
    this.length += 4;
  }

  f32(value: number): void {
    this.reserve(4);
    this.view.setFloat32(this.length, value, true);
    this.length += 4;
  }

  f64(...values: readonly number[]): void {
    this.reserve(8 * values.length);
    for (const value of values) {
      this.view.setFloat64(this.length, value, true);
      this.length += 8;
    }
  }

  /** Unsigned integer below 2⁵³ in groups of 7 bits, the lowest first, the top bit set on all but the last. */
  varint(value: number): void {
    let rest = value;
    while (rest >= 128) {
      this.u8((rest % 128) + 128);
      rest = Math.floor(rest / 128);
    }
    this.u8(rest);
  }

  /** UTF-8 text of at most 65,535 bytes, its length before it. */
  text(value: string): void {
    const encoded = new TextEncoder().encode(value);
    this.u16(encoded.length);
    this.raw(encoded);
  }

  raw(bytes: Uint8Array): void {
    this.reserve(bytes.length);
    this.bytes.set(bytes, this.length);
    this.length += bytes.length;
  }

  finish(): Uint8Array {
    return this.bytes.slice(0, this.length);
  }

  private reserve(count: number): void {
    if (this.length + count <= this.bytes.length) return;
    const larger = new Uint8Array(Math.max(2 * this.bytes.length, this.length + count));
    larger.set(this.bytes);
    this.bytes = larger;
    this.view = new DataView(larger.buffer);
  }
}

/** Reads what {@link ByteWriter} wrote; every read is checked against the end. */
export class ByteReader {
  private readonly view: DataView;
  private at = 0;

  constructor(
    private readonly bytes: Uint8Array,
    private readonly file: string,
  ) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  get remaining(): number {
    return this.bytes.length - this.at;
  }

  /** @throws RecordError RECORD_TRUNCATED unless so many bytes are left; call it before allocating for them */
  require(count: number): void {
    if (count <= this.remaining) return;
    throw this.fault(
      "RECORD_TRUNCATED",
      `the georeference record ends at byte ${this.bytes.length}, before its contents do`,
    );
  }

  fault(code: `RECORD_${string}`, cause: string): RecordError {
    return new RecordError({ code, file: this.file, cause, fix: "convert the original scan again" });
  }

  /** @throws RecordError RECORD_INVALID unless the condition holds */
  check(condition: boolean, what: string): void {
    if (!condition)
      throw this.fault("RECORD_INVALID", `the georeference record has ${what} (byte ${this.at})`);
  }

  u8(): number {
    return this.view.getUint8(this.advance(1));
  }

  u16(): number {
    return this.view.getUint16(this.advance(2), true);
  }

  u32(): number {
    return this.view.getUint32(this.advance(4), true);
  }

  f32(): number {
    return this.view.getFloat32(this.advance(4), true);
  }

  /** A finite float64. */
  f64(what: string): number {
    const value = this.view.getFloat64(this.advance(8), true);
    this.check(Number.isFinite(value), `${what} that is not a finite number`);
    return value;
  }

  /** A finite float64 above zero. */
  positive(what: string): number {
    const value = this.f64(what);
    this.check(value > 0, `${what} of ${value}`);
    return value;
  }

  nonZero(what: string): number {
    const value = this.f64(what);
    this.check(value !== 0, `${what} of ${value}`);
    return value;
  }

  varint(): number {
    let value = 0;
    for (let scale = 1; ; scale *= 128) {
      const byte = this.u8();
      value += (byte & 127) * scale;
      this.check(value <= Number.MAX_SAFE_INTEGER, "an integer beyond 53 bits");
      if (byte < 128) return value;
    }
  }

  text(what: string): string {
    const length = this.u16();
    const from = this.advance(length);
    try {
      return new TextDecoder("utf-8", { fatal: true }).decode(this.bytes.subarray(from, from + length));
    } catch {
      throw this.fault("RECORD_INVALID", `the georeference record has ${what} that is no UTF-8 text`);
    }
  }

  private advance(count: number): number {
    this.require(count);
    const from = this.at;
    this.at += count;
    return from;
  }
}
