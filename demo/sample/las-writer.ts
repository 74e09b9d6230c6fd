/** One point of LAS 1.4 point record format 7, in units of the file's reader: metres, radians, seconds. */
export interface LasPoint {
  x: number;
  y: number;
  z: number;
  intensity: number;
  returnNumber: number;
  returns: number;
  classification: number;
  edgeOfFlightLine: boolean;
  /** Channel of the scanner head, 0 to 3. */
  scannerChannel: number;
  /** Radians from the vertical, right of the flight direction positive. */
  scanAngle: number;
  pointSource: number;
  /** Adjusted standard GPS time. */
  gpsTime: number;
  red: number;
  green: number;
  blue: number;
}

export interface LasOptions {
  wkt: string;
  /** Coordinates are stored as integers of `scale` metres from here. */
  offset: readonly [number, number, number];
  scale: number;
  systemIdentifier: string;
  generatingSoftware: string;
  /** Day of the year (1 to 366) and year of creation. */
  created: { day: number; year: number };
}

const HEADER_SIZE = 375;
const VLR_HEADER_SIZE = 54;
const RECORD_SIZE = 36;
/** LAS 1.4 table 6: GPS time is adjusted standard time (bit 0), the CRS is WKT (bit 4). */
const GLOBAL_ENCODING = 0b10001;
const SCAN_ANGLE_UNIT = (0.006 * Math.PI) / 180;

/** Collects points and makes one uncompressed LAS 1.4 file of them, point format 7 with a WKT record. */
export class LasWriter {
  readonly #options: LasOptions;
  readonly #wkt: Uint8Array;
  readonly #first: number;
  #bytes: Uint8Array;
  #view: DataView;
  #count = 0;
  readonly #byReturn = new Array<number>(15).fill(0);
  readonly #min = [Infinity, Infinity, Infinity];
  readonly #max = [-Infinity, -Infinity, -Infinity];

  /** `expected` points are made room for; more may come. */
  constructor(options: LasOptions, expected: number) {
    this.#options = options;
    this.#wkt = new TextEncoder().encode(`${options.wkt}\0`);
    this.#first = HEADER_SIZE + VLR_HEADER_SIZE + this.#wkt.length;
    this.#bytes = new Uint8Array(this.#first + Math.ceil(expected * 1.1) * RECORD_SIZE);
    this.#view = new DataView(this.#bytes.buffer);
  }

  /** Points added so far. */
  get count(): number {
    return this.#count;
  }

  /** Appends a point; its object may be reused. */
  add(point: LasPoint): void {
    const at = this.#first + this.#count * RECORD_SIZE;
    if (at + RECORD_SIZE > this.#bytes.length) this.#grow();
    const view = this.#view;
    view.setInt32(at, this.#quantise(0, point.x), true);
    view.setInt32(at + 4, this.#quantise(1, point.y), true);
    view.setInt32(at + 8, this.#quantise(2, point.z), true);
    view.setUint16(at + 12, point.intensity, true);
    view.setUint8(at + 14, point.returnNumber | (point.returns << 4));
    view.setUint8(at + 15, (point.scannerChannel << 4) | (1 << 6) | (point.edgeOfFlightLine ? 1 << 7 : 0));
    view.setUint8(at + 16, point.classification);
    view.setInt16(at + 18, Math.round(point.scanAngle / SCAN_ANGLE_UNIT), true);
    view.setUint16(at + 20, point.pointSource, true);
    view.setFloat64(at + 22, point.gpsTime, true);
    view.setUint16(at + 30, point.red, true);
    view.setUint16(at + 32, point.green, true);
    view.setUint16(at + 34, point.blue, true);
    this.#byReturn[point.returnNumber - 1]++;
    this.#count++;
  }

  /** The finished file. */
  finish(): Uint8Array {
    this.#writeHeader();
    this.#writeWkt();
    return this.#bytes.subarray(0, this.#first + this.#count * RECORD_SIZE);
  }

  #quantise(axis: number, value: number): number {
    const { offset, scale } = this.#options;
    const stored = Math.round((value - offset[axis]) / scale);
    this.#min[axis] = Math.min(this.#min[axis], stored);
    this.#max[axis] = Math.max(this.#max[axis], stored);
    return stored;
  }

  #grow(): void {
    const bytes = new Uint8Array(Math.ceil(this.#bytes.length * 1.5) + RECORD_SIZE);
    bytes.set(this.#bytes);
    this.#bytes = bytes;
    this.#view = new DataView(bytes.buffer);
  }

  #writeHeader(): void {
    const { offset, scale, systemIdentifier, generatingSoftware, created } = this.#options;
    const view = this.#view;
    this.#text(0, "LASF");
    view.setUint16(6, GLOBAL_ENCODING, true);
    view.setUint8(24, 1);
    view.setUint8(25, 4);
    this.#text(26, systemIdentifier.slice(0, 31));
    this.#text(58, generatingSoftware.slice(0, 31));
    view.setUint16(90, created.day, true);
    view.setUint16(92, created.year, true);
    view.setUint16(94, HEADER_SIZE, true);
    view.setUint32(96, this.#first, true);
    view.setUint32(100, 1, true);
    view.setUint8(104, 7);
    view.setUint16(105, RECORD_SIZE, true);
    for (let axis = 0; axis < 3; axis++) {
      view.setFloat64(131 + 8 * axis, scale, true);
      view.setFloat64(155 + 8 * axis, offset[axis], true);
      view.setFloat64(179 + 16 * axis, this.#max[axis] * scale + offset[axis], true);
      view.setFloat64(187 + 16 * axis, this.#min[axis] * scale + offset[axis], true);
    }
    view.setBigUint64(247, BigInt(this.#count), true);
    for (let i = 0; i < 15; i++) view.setBigUint64(255 + 8 * i, BigInt(this.#byReturn[i]), true);
  }

  #writeWkt(): void {
    this.#text(HEADER_SIZE + 2, "LASF_Projection");
    this.#view.setUint16(HEADER_SIZE + 18, 2112, true);
    this.#view.setUint16(HEADER_SIZE + 20, this.#wkt.length, true);
    this.#text(HEADER_SIZE + 22, "OGC WKT");
    this.#bytes.set(this.#wkt, HEADER_SIZE + VLR_HEADER_SIZE);
  }

  #text(at: number, text: string): void {
    this.#bytes.set(new TextEncoder().encode(text), at);
  }
}
