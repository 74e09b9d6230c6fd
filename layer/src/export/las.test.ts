import { describe, expect, it } from "vitest";
import type { PointBatch, PointOrigin } from "../query/index.js";
import type { LasEnvelope, LasVariableRecord } from "../sources/contract/point-source.js";
import { MemorySink } from "./byte-sink.js";
import { exportLas } from "./las.js";
import type { PointSelection } from "./selection.js";

const RECORD = 30;

function variableRecord(
  userId: string,
  recordId: number,
  content: Uint8Array,
  extended = false,
): LasVariableRecord {
  const header = new Uint8Array(extended ? 60 : 54);
  const view = new DataView(header.buffer);
  header.set(new TextEncoder().encode(userId), 2);
  view.setUint16(18, recordId, true);
  if (extended) view.setBigUint64(20, BigInt(content.length), true);
  else view.setUint16(20, content.length, true);
  return { userId, recordId, extended, header, content };
}

function envelopeOf(extra: number, records: readonly LasVariableRecord[], scale = 0.01): LasEnvelope {
  const header = new Uint8Array(375);
  const view = new DataView(header.buffer);
  header.set(new TextEncoder().encode("LASF"));
  view.setUint16(94, 375, true);
  for (const at of [131, 139, 147]) view.setFloat64(at, scale, true);
  return { header, pointFormat: 6, recordLength: RECORD + extra, records };
}

/** Points along the x axis in one node, each byte of a record its own. */
function selectionOf(count: number, envelope: LasEnvelope | undefined, name = "scan.copc.laz") {
  const length = envelope?.recordLength ?? RECORD;
  const lasRecords = Uint8Array.from({ length: count * length }, (_, index) => (index * 7) % 251);
  const view = new DataView(lasRecords.buffer);
  const xyz = new Int32Array(3 * count);
  for (let point = 0; point < count; point++) {
    xyz.set([100 * point, 200, -300 - point], 3 * point);
    for (let axis = 0; axis < 3; axis++)
      view.setInt32(point * length + 4 * axis, xyz[3 * point + axis], true);
    lasRecords[point * length + 14] = 16 * 3 + (point % 4);
    lasRecords[point * length + 16] = point % 3;
  }
  const classes = { name: "classification", bytes: lasRecords, at: 16, stride: length };
  const records = { count, xyz, attributes: [classes], lasRecords };
  const inside = Uint32Array.from({ length: count }, (_, index) => index);
  const query = {
    bracket: async () => ({ least: count, most: count, nodes: 1 }),
    async *batches() {
      yield { node: "0-0-0-0", records, inside } as unknown as PointBatch;
    },
  };
  const origin = {
    ...{ name, scale: [0.01, 0.01, 0.01], offset: [0, 0, 0] },
    query: () => query,
    lasEnvelope: async () => envelope,
  } as unknown as PointOrigin;
  return { selection: { origin } satisfies PointSelection as PointSelection, lasRecords };
}

async function written(selections: readonly PointSelection[], options = {}): Promise<DataView> {
  const sink = new MemorySink();
  await exportLas(selections, sink, options);
  return new DataView(await sink.blob().arrayBuffer());
}

const bytesOf = (view: DataView, begin: number, end: number) => new Uint8Array(view.buffer.slice(begin, end));

const wkt = variableRecord("LASF_Projection", 2112, new TextEncoder().encode("PROJCS[…]"));

describe("LAS from recorded points", () => {
  it("has the records as they are, their count, returns and bounds, and what stands around them", async () => {
    const behind = variableRecord("somebody", 7, Uint8Array.of(1, 2, 3), true);
    const { selection, lasRecords } = selectionOf(40, envelopeOf(0, [wkt, behind]));
    const file = await written([selection]);
    const points = file.getUint32(96, true);
    expect(points).toBe(375 + 54 + wkt.content.length);
    expect(bytesOf(file, 375, points)).toEqual(Uint8Array.from([...wkt.header, ...wkt.content]));
    expect(bytesOf(file, points, points + 40 * RECORD)).toEqual(lasRecords);
    expect(Number(file.getBigUint64(235, true))).toBe(points + 40 * RECORD);
    expect(file.getUint32(243, true)).toBe(1);
    expect(bytesOf(file, points + 40 * RECORD, file.byteLength)).toEqual(
      Uint8Array.from([...behind.header, ...behind.content]),
    );
    expect(file.getUint32(100, true)).toBe(1);
    expect([file.getUint8(104), file.getUint16(105, true)]).toEqual([6, RECORD]);
    expect(Number(file.getBigUint64(247, true))).toBe(40);
    expect([1, 2, 3, 4].map((number) => Number(file.getBigUint64(247 + 8 * number, true)))).toEqual([
      10, 10, 10, 0,
    ]);
    expect([179, 187, 195, 203, 211, 219].map((at) => file.getFloat64(at, true))).toEqual([
      ...[39 * 100 * 0.01, 0, 2, 2, -3, -339 * 0.01],
    ]);
  });

  it("is the same whatever the blocks are that it is gathered in", async () => {
    const { selection, lasRecords } = selectionOf(90_000, envelopeOf(0, []));
    const file = await written([selection]);
    // Compared at once: element by element it takes half a minute.
    expect(Buffer.compare(bytesOf(file, 375, file.byteLength), lasRecords)).toBe(0);
  });

  it("gets chainage and offset behind the records, described after what was described", async () => {
    const described = new Uint8Array(192);
    described[2] = 3;
    described.set(new TextEncoder().encode("offset"), 4);
    const extra = variableRecord("LASF_Spec", 4, described);
    // Two bytes are described, 300 are not: these have to be, or what follows them is misread.
    const { selection, lasRecords } = selectionOf(3, envelopeOf(302, [extra]));
    const along = {
      vertices: [],
      chainages: [],
      locate(x: number, y: number, out: Float64Array) {
        out.set([x, y]);
      },
    };
    const file = await written([{ ...selection, along }], { chainage: true });
    const points = file.getUint32(96, true);
    expect(file.getUint16(105, true)).toBe(RECORD + 318);
    expect(file.getUint16(375 + 20, true)).toBe(5 * 192);
    const fields = [0, 1, 2, 3, 4].map((index) => {
      const at = 375 + 54 + 192 * index;
      const name = new TextDecoder().decode(bytesOf(file, at + 4, at + 36)).replace(/\0.*$/, "");
      return [file.getUint8(at + 2), file.getUint8(at + 3), name];
    });
    expect(fields).toEqual([
      [3, 0, "offset"],
      [0, 255, ""],
      [0, 45, ""],
      [10, 0, "chainage"],
      [10, 0, "offset 2"],
    ]);
    for (let point = 0; point < 3; point++) {
      const at = points + point * (RECORD + 318);
      const from = point * (RECORD + 302);
      expect(bytesOf(file, at, at + RECORD + 302)).toEqual(lasRecords.slice(from, from + RECORD + 302));
      expect(file.getFloat64(at + RECORD + 302, true)).toBe(point);
      expect(file.getFloat64(at + RECORD + 310, true)).toBe(2);
    }
  });

  it("takes the classes that are wanted alone", async () => {
    const { selection } = selectionOf(9, envelopeOf(0, []));
    const file = await written([{ ...selection, classes: new Set([2]) }]);
    expect(Number(file.getBigUint64(247, true))).toBe(3);
    expect([0, 1, 2].map((point) => file.getUint8(375 + point * RECORD + 16))).toEqual([2, 2, 2]);
  });

  it("joins data sets whose records mean the same, without what holds for one alone", async () => {
    const groma = variableRecord("groma", 1, Uint8Array.of(9));
    const parts = [5, 4].map((count) => selectionOf(count, envelopeOf(0, [wkt, groma])));
    const file = await written(parts.map(({ selection }) => selection));
    const points = file.getUint32(96, true);
    expect(file.getUint32(100, true)).toBe(1);
    expect(bytesOf(file, points, file.byteLength)).toEqual(
      Uint8Array.from(parts.flatMap(({ lasRecords }) => [...lasRecords])),
    );
  });

  it("refuses data sets whose records differ in meaning, and points that are no LAS records", async () => {
    const { selection } = selectionOf(1, envelopeOf(0, [wkt]));
    const others = [
      [envelopeOf(0, [wkt], 0.001), "different scales"],
      [envelopeOf(0, []), "different coordinate reference systems"],
      [envelopeOf(2, [wkt]), "different extra bytes"],
      [{ ...envelopeOf(0, [wkt]), pointFormat: 7 }, "point formats 6 and 7"],
    ] as const;
    for (const [envelope, words] of others) {
      const { selection: other } = selectionOf(1, envelope, "other.copc.laz");
      const refusal = written([selection, other]);
      await expect(refusal).rejects.toMatchObject({ code: "EXPORT_MIXED", file: "other.copc.laz" });
      await expect(refusal).rejects.toThrow(words);
    }
    await expect(written([selectionOf(1, undefined).selection])).rejects.toMatchObject({
      code: "EXPORT_NO_LAS",
    });
  });
});
