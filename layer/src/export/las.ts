import { FormatError } from "../errors/index.js";
import type { LasEnvelope } from "../sources/contract/point-source.js";
import type { ByteSink } from "./byte-sink.js";
import { type LasBody, PlainBody } from "./las-body.js";
import { type AddedAttribute, LasFrames } from "./las-file.js";
import { type ExportOptions, eachBatch, type PointSelection, spacingOf } from "./selection.js";

/** How LAS is written. */
export interface LasOptions extends ExportOptions {
  /** Adds `chainage` and `offset` along the selection's line to each record, float64 extra bytes; `chainage 2` where records have that name. Default: false. */
  readonly chainage?: boolean | undefined;
}

/** Bytes of records of formats 6 to 8 without extra bytes (LAS 1.4 R15, tables 15 to 17). */
const BASE_LENGTH: Readonly<Record<number, number>> = { 6: 30, 7: 36, 8: 38 };

const ALONG: readonly AddedAttribute[] = [
  { name: "chainage", description: "distance along the line" },
  { name: "offset", description: "from the line, left positive" },
];

const NOTHING: readonly AddedAttribute[] = [];

/** Byte of a record that has the return number in its lower half (LAS 1.4 R15, table 15). */
const RETURN_NUMBER = 14;

/**
 * Writes points as LAS 1.4: their records bit for bit, in the order of the octree, one data set after the other, and all
 * that the header and the variable length records of the (first) data set say of them. What follows from the points
 * (counts, bounds) is made anew; records of the octree, of LAZ and of all points together are left out, and of several
 * data sets Groma's georeference as well, which holds within the bounds of one.
 *
 * @param selections of data sets whose records mean the same: point format, scale, offset, CRS, extra bytes
 * @param sink gets the header again once the points are counted
 * @returns number of points
 * @throws FormatError EXPORT_NO_LAS where points are no LAS records, EXPORT_MIXED where they cannot stand in one file
 * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted; what the sink throws
 */
export async function exportLas(
  selections: readonly PointSelection[],
  sink: ByteSink,
  options: LasOptions = {},
): Promise<number> {
  return writeLas(selections, sink, options, async () => new PlainBody(sink));
}

/** Makes the body of a file. @param layout point format, bytes of a record, and those of them that the format does not have */
type MakeBody = (layout: {
  readonly format: number;
  readonly length: number;
  readonly extra: number;
}) => Promise<LasBody>;

/**
 * As {@link exportLas}, with points as a body writes them.
 * @param frames of the files that are written one after the other
 */
export async function writeLas(
  selections: readonly PointSelection[],
  sink: ByteSink,
  options: LasOptions,
  makeBody: MakeBody,
  frames = new LasFrames(),
): Promise<number> {
  const envelope = withSpacing(await commonEnvelope(selections, options.signal), selections);
  const { pointFormat, recordLength } = envelope;
  const chainage = options.chainage === true;
  const base = BASE_LENGTH[pointFormat];
  const frame = frames.of(envelope, base, chainage ? ALONG : NOTHING);
  const { recordLength: length } = frame;
  const body = await makeBody({ format: pointFormat, length, extra: length - base });
  const points = new PointTally();
  await sink.write(body.front(frame.front(points.summary(selections[0].origin))));
  await eachBatch(selections, options, async ({ records }, wanted, { origin, along }) => {
    const { lasRecords: from, xyz } = records;
    if (!from) throw noLas(origin.name);
    points.add(xyz, from, recordLength, wanted);
    const to = copyRecords(from, recordLength, wanted, frame.recordLength);
    if (chainage) putAlong(to, recordLength, frame.recordLength, xyz, wanted, origin, along);
    await body.take(to);
  });
  await body.end();
  const back = frame.back();
  if (back.length > 0) await sink.write(back);
  await sink.overwrite(0, body.front(frame.front(points.summary(selections[0].origin))));
  return points.count;
}

/** Record of a file of which points were left out: user and number. */
const THINNED = { user: "groma", id: 10 } as const;

/** Names the spacing that was asked for, in a record of its own, so that nobody takes the file for a complete one. */
function withSpacing(envelope: LasEnvelope, selections: readonly PointSelection[]): LasEnvelope {
  const spacing = spacingOf(selections);
  if (spacing === 0) return envelope;
  const content = new TextEncoder().encode(`thinned: one point in about ${spacing}\0`);
  const header = new Uint8Array(54);
  header.set(new TextEncoder().encode(THINNED.user), 2);
  header.set(new TextEncoder().encode("points were left out"), 22);
  const view = new DataView(header.buffer);
  view.setUint16(18, THINNED.id, true);
  view.setUint16(20, content.length, true);
  const record = { userId: THINNED.user, recordId: THINNED.id, extended: false, header, content };
  return { ...envelope, records: [...envelope.records, record] };
}

function copyRecords(
  from: Uint8Array,
  length: number,
  wanted: Uint32Array,
  step: number,
): Uint8Array<ArrayBuffer> {
  const to = new Uint8Array(step * wanted.length);
  for (let index = 0, at = 0; index < wanted.length; index++, at += step) {
    const begin = wanted[index] * length;
    for (let byte = 0; byte < length; byte++) to[at + byte] = from[begin + byte];
  }
  return to;
}

/** Puts chainage and offset behind each record; NaN where there is no line. */
function putAlong(
  to: Uint8Array,
  length: number,
  step: number,
  xyz: Int32Array,
  wanted: Uint32Array,
  { scale, offset }: PointSelection["origin"],
  along: PointSelection["along"],
): void {
  const view = new DataView(to.buffer, to.byteOffset, to.byteLength);
  const place = new Float64Array(2).fill(Number.NaN);
  for (let index = 0, at = length; index < wanted.length; index++, at += step) {
    const point = 3 * wanted[index];
    const z = xyz[point + 2] * scale[2] + offset[2];
    along?.locate(xyz[point] * scale[0] + offset[0], xyz[point + 1] * scale[1] + offset[1], place, z);
    view.setFloat64(at, place[0], true);
    view.setFloat64(at + 8, place[1], true);
  }
}

/** Bytes of the header that say what the integers mean: scale and offset. */
const MEANING = [131, 179] as const;

/**
 * What a file with the points of several data sets begins and ends with.
 * @throws FormatError EXPORT_NO_LAS, EXPORT_MIXED
 */
async function commonEnvelope(
  selections: readonly PointSelection[],
  signal: AbortSignal | undefined,
): Promise<LasEnvelope> {
  const envelopes = await Promise.all(
    selections.map(async ({ origin }) => {
      const envelope = await origin.lasEnvelope({ signal });
      if (!envelope) throw noLas(origin.name);
      return envelope;
    }),
  );
  const [first, ...others] = envelopes;
  for (const [index, other] of others.entries()) {
    const difference = differenceOf(first, other);
    if (difference) throw mixed(selections[0].origin.name, selections[index + 1].origin.name, difference);
  }
  if (others.length === 0) return first;
  return { ...first, records: first.records.filter(({ userId }) => userId !== "groma") };
}

/** Why records of two files cannot stand in one; undefined where they can. */
function differenceOf(a: LasEnvelope, b: LasEnvelope): string | undefined {
  if (a.pointFormat !== b.pointFormat) return `point formats ${a.pointFormat} and ${b.pointFormat}`;
  if (!areSame(a.header.subarray(...MEANING), b.header.subarray(...MEANING)))
    return "different scales or offsets";
  if (!areSame(contents(a, "LASF_Projection"), contents(b, "LASF_Projection"))) {
    return "different coordinate reference systems, or different words for one";
  }
  const described = areSame(contents(a, "LASF_Spec", 4), contents(b, "LASF_Spec", 4));
  return a.recordLength === b.recordLength && described ? undefined : "different extra bytes";
}

function contents({ records }: LasEnvelope, userId: string, recordId?: number): Uint8Array {
  const found = records.filter((one) => one.userId === userId && (recordId ?? one.recordId) === one.recordId);
  return Uint8Array.from(found.flatMap(({ recordId: id, content }) => [id & 255, id >> 8, ...content]));
}

function areSame(a: Uint8Array, b: Uint8Array): boolean {
  return a.length === b.length && a.every((byte, index) => byte === b[index]);
}

/** Counts points and finds their bounds, by their integers. */
class PointTally {
  count = 0;
  readonly #returns = new Float64Array(16);
  readonly #least = new Float64Array(3).fill(Number.POSITIVE_INFINITY);
  readonly #greatest = new Float64Array(3).fill(Number.NEGATIVE_INFINITY);

  add(xyz: Int32Array, bytes: Uint8Array, length: number, wanted: Uint32Array): void {
    this.count += wanted.length;
    for (const point of wanted) {
      this.#returns[bytes[point * length + RETURN_NUMBER] & 15]++;
      for (let axis = 0; axis < 3; axis++) {
        const value = xyz[3 * point + axis];
        if (value < this.#least[axis]) this.#least[axis] = value;
        if (value > this.#greatest[axis]) this.#greatest[axis] = value;
      }
    }
  }

  summary({ scale, offset }: PointSelection["origin"]) {
    const bounds = new Float64Array(6);
    for (let axis = 0; axis < 3; axis++) {
      bounds[axis] = this.#least[axis] * scale[axis] + offset[axis];
      bounds[axis + 3] = this.#greatest[axis] * scale[axis] + offset[axis];
    }
    return { count: this.count, returns: this.#returns, bounds };
  }
}

function mixed(first: string, other: string, difference: string): FormatError {
  return new FormatError({
    code: "EXPORT_MIXED",
    file: other,
    cause: `its records cannot stand in one LAS file with those of ${first}: ${difference}`,
    fix: "Write a file for each of them",
  });
}

function noLas(file: string): FormatError {
  return new FormatError({
    code: "EXPORT_NO_LAS",
    file,
    cause: "its points are no LAS records",
    fix: "Export them as CSV, GeoJSON or DXF",
  });
}
