import { expect, it } from "vitest";
import { decode } from "../../workers/decoders.js";
import type { LazDecoder } from "../../workers/laz-decoder.js";
import { BlobSource } from "../bytes/blob-source.js";
import { crc32c } from "../contract/checksum.js";
import { CopcSource } from "./copc-source.js";
import { pageBytes, type TinyCopc, tinyCopc } from "./tiny-copc.fixture.js";

const PAGE = [
  [0, 0, 0, 0, 0, 100, 10],
  [1, 0, 0, 0, 0, 0, 0],
  [1, 1, 0, 0, 0, 40, 5],
];

/** Groma's record 4. */
function record(checksums: readonly number[], hierarchy: number, method = 1): Uint8Array {
  const bytes = new Uint8Array(16 + 4 * checksums.length);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, method, true);
  view.setUint32(4, checksums.length, true);
  view.setBigUint64(8, BigInt(hierarchy), true);
  for (const [index, checksum] of checksums.entries()) view.setUint32(16 + 4 * index, checksum, true);
  return bytes;
}

/** The file that `options` makes with the byte of its root page. */
function withPageOffset(options: (pageOffset: number) => TinyCopc): Uint8Array {
  const draft = tinyCopc({ page: PAGE, ...options(0) });
  const offset = Number(new DataView(draft.buffer).getBigUint64(469, true));
  return tinyCopc({ page: PAGE, ...options(offset) });
}

/** A source that keeps the requests made of it. */
function watched(bytes: Uint8Array) {
  const reads: [number, number][] = [];
  const whole = new BlobSource(new Blob([bytes.slice()]));
  const source = {
    name: whole.name,
    size: whole.size,
    read: (begin: number, end: number) => {
      reads.push([begin, end]);
      return whole.read(begin, end);
    },
  };
  return { source, reads };
}

async function checksumsOf(bytes: Uint8Array): Promise<(number | undefined)[]> {
  const source = await CopcSource.open(watched(bytes).source);
  const entries = [...(await source.page(source.rootPage))].filter(({ pointCount }) => pointCount > 0);
  return Promise.all(entries.map(async ({ address }) => (await source.chunk(address)).checksum));
}

/** What tells that a file is Groma's. */
const STATISTICS = [
  "groma",
  2,
  new TextEncoder().encode(
    '{"version":1,"points":10,"rgbBits":null,"attributes":[],"classes":{},"returns":{}}',
  ),
] as const;

it("come with the chunks, from a record in front", async () => {
  const bytes = withPageOffset((offset) => ({ records: [["groma", 4, record([7, 0, 9], offset)]] }));
  expect(await checksumsOf(bytes)).toEqual([7, 9]);
});

it("come with the chunks, from a record behind the points, together with the page", async () => {
  const bytes = withPageOffset((offset) => ({
    records: [STATISTICS],
    ahead: ["groma", 4, record([7, 0, 9], offset)],
  }));
  expect(await checksumsOf(bytes)).toEqual([7, 9]);
  const { source, reads } = watched(bytes);
  const copc = await CopcSource.open(source);
  const behind = reads.filter(([begin]) => begin > 700);
  expect(behind).toHaveLength(1);
  const before = reads.length;
  await copc.page(copc.rootPage);
  expect(reads).toHaveLength(before);
});

/** Groma's record 5: version, number, byte of the page, the page, its checksums. */
function firstPage(rows: readonly number[][], checksums: readonly number[], offset: number, version = 1) {
  const page = pageBytes(rows);
  const bytes = new Uint8Array(16 + page.length + 4 * checksums.length);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, version, true);
  view.setUint32(4, rows.length, true);
  view.setBigUint64(8, BigInt(offset), true);
  bytes.set(page, 16);
  for (const [index, checksum] of checksums.entries())
    view.setUint32(16 + page.length + 4 * index, checksum, true);
  return bytes;
}

/** The page with chunks that begin behind such a record. */
const ROWS = PAGE.map(([depth, x, y, z, , length, points]) => [depth, x, y, z, 830, length / 10, points]);
/** With it, nothing is looked for behind the points. */
const GEOREFERENCE = ["groma", 1, new Uint8Array(9)] as const;

it("come with a copy of the first page in front, which costs no request", async () => {
  const bytes = withPageOffset((offset) => ({
    page: ROWS,
    records: [GEOREFERENCE, ["groma", 5, firstPage(ROWS, [7, 0, 9], offset)]],
  }));
  expect(await checksumsOf(bytes)).toEqual([7, 9]);
  const { source, reads } = watched(bytes);
  const copc = await CopcSource.open(source);
  await copc.page(copc.rootPage);
  expect(Math.max(...reads.map(([, end]) => end))).toBeLessThan(copc.rootPage.offset);
});

it("come with no copy of a page that is another file's, damaged, or of a version that is not known", async () => {
  const lies = ROWS.map((row) => row.with(6, 1));
  const copies: ((offset: number) => Uint8Array)[] = [
    (offset) => firstPage(lies, [7, 0, 9], offset + 1),
    (offset) => firstPage(lies, [7, 0, 9], offset, 2),
    (offset) => firstPage(lies, [7, 0], offset),
    (offset) => firstPage(lies.slice(1), [7, 0], offset),
    (offset) => firstPage(lies, [7, 0, 9], offset).subarray(0, 12),
  ];
  for (const copy of copies) {
    const bytes = withPageOffset((offset) => ({
      page: ROWS,
      records: [GEOREFERENCE, ["groma", 5, copy(offset)]],
    }));
    const source = await CopcSource.open(watched(bytes).source);
    const entries = [...(await source.page(source.rootPage))];
    expect(entries.map(({ pointCount }) => pointCount)).toEqual(ROWS.map((row) => row[6]));
  }
});

it("are none where there is no record, or that of another file or method", async () => {
  const none = [undefined, undefined];
  expect(await checksumsOf(tinyCopc({ page: PAGE }))).toEqual(none);
  const others: ((offset: number) => Uint8Array)[] = [
    (offset) => record([7, 0, 9], offset + 1),
    (offset) => record([7, 0, 9], offset, 2),
    (offset) => record([7, 0, 9], offset).subarray(0, 27),
    (offset) => record([7, 0, 9], offset).subarray(0, 15),
  ];
  for (const other of others) {
    const bytes = withPageOffset((offset) => ({ records: [["groma", 4, other(offset)]] }));
    expect(await checksumsOf(bytes)).toEqual(none);
  }
  const foreign = withPageOffset(() => ({
    records: [STATISTICS],
    ahead: ["someone", 4, new Uint8Array(40)],
  }));
  expect(await checksumsOf(foreign)).toEqual(none);
});

it("FORMAT_CHECKSUMS for a page that they do not cover", async () => {
  const bytes = withPageOffset((offset) => ({ records: [["groma", 4, record([7, 0], offset)]] }));
  await expect(checksumsOf(bytes)).rejects.toMatchObject({ code: "FORMAT_CHECKSUMS" });
});

it("DECODE_CHECKSUM before anything is decoded, whichever byte is damaged", async () => {
  const chunk = Uint8Array.from({ length: 60 }, (_, index) => (index * 41) & 255);
  const checksum = crc32c(chunk);
  let decoded = 0;
  const laz = { decode: async () => decoded++ } as unknown as LazDecoder;
  const encoding = { kind: "laz", pointFormat: 7, recordLength: 36, extraLength: 0, fields: [] } as const;
  const expected = { pointCount: 1, file: "a.copc.laz", node: "1-0-0-1" };
  for (let at = 0; at < chunk.length; at++) {
    chunk[at]! ^= 1 << (at & 7);
    await expect(decode({ laz }, chunk, encoding, { ...expected, checksum })).rejects.toMatchObject({
      code: "DECODE_CHECKSUM",
      file: "a.copc.laz",
      cause: expect.stringContaining("node 1-0-0-1"),
    });
    chunk[at]! ^= 1 << (at & 7);
  }
  expect(decoded).toBe(0);
  await decode({ laz }, chunk, encoding, { ...expected, checksum });
  await decode({ laz }, new Uint8Array(3), encoding, expected);
  expect(decoded).toBe(2);
});
