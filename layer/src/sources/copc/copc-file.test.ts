import { GromaError } from "@groma/georef";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { BlobSource } from "../bytes/blob-source.js";
import { KnownParts } from "../bytes/known-parts.js";
import { openCopc } from "./copc-file.js";
import { CopcSource } from "./copc-source.js";
import { type TinyCopc, tinyCopc } from "./tiny-copc.fixture.js";

const source = (bytes: Uint8Array) => new BlobSource(new Blob([bytes.slice()]), "tiny.copc.laz");
const open = (options?: TinyCopc) => openCopc(new KnownParts(source(tinyCopc(options))));

const statistics = new TextEncoder().encode(
  JSON.stringify({
    version: 1,
    points: 10,
    rgbBits: 8,
    attributes: [{ name: "intensity", min: 1, max: 9, mean: 4 }],
    classes: { 2: 10 },
    returns: { 1: 10 },
  }),
);

/** The same with a class that every object has something under. */
const misnamed = new TextEncoder().encode(
  new TextDecoder().decode(statistics).replace('{"2":10}', '{"__proto__":10}'),
);

describe("openCopc", () => {
  it("reads header, octree, WKT and statistics", async () => {
    const copc = await open({ wkt: 'PROJCS["x"]', records: [["groma", 2, statistics]] });
    expect(copc.header).toMatchObject({ pointFormat: 7, recordLength: 36, pointCount: 10 });
    expect(copc.header.max).toEqual([100, 100, 50]);
    expect(copc.info).toMatchObject({ center: [50, 50, 50], halfSize: 50, spacing: 1 });
    expect(copc.crs.wkt).toBe('PROJCS["x"]');
    expect(copc.statistics?.rgbBits).toBe(8);
    const opened = await CopcSource.open(copc.source);
    const [root] = await opened.page(opened.rootPage);
    expect(root.pointCount).toBe(10);
  });

  it.each([
    ["octree size", 24, 1e300],
    ["octree size", 24, 1e9],
    ["octree centre", 0, -1e300],
    ["octree centre", 16, 1e9],
  ])("FORMAT_HEADER for an %s that no integers can reach", async (what, at, value) => {
    const bytes = tinyCopc();
    new DataView(bytes.buffer).setFloat64(429 + at, value, true);
    const cause = expect.stringContaining(what);
    const error = expect.objectContaining({ code: "FORMAT_HEADER", cause });
    await expect(openCopc(new KnownParts(source(bytes)))).rejects.toThrow(error);
  });

  it("keeps GeoTIFF keys as they are recorded", async () => {
    const directory = new Uint8Array(Uint16Array.of(1, 1, 0, 1, 3072, 0, 1, 2056).buffer);
    const { crs } = await open({ records: [["LASF_Projection", 34735, directory]] });
    expect([...(crs.geoTiff?.directory ?? [])]).toEqual([1, 1, 0, 1, 3072, 0, 1, 2056]);
    expect(crs.geoTiff?.doubles).toHaveLength(0);
  });

  describe("the transformation in record groma 3", () => {
    const georeference = ["groma", 1, new Uint8Array(9)] as const;
    const bytes = Uint8Array.from({ length: 70_000 }, (_, i) => i % 251);

    it("is read from a VLR, and does not keep the whole opening alive", async () => {
      const { crs } = await open({ records: [georeference, ["groma", 3, bytes.subarray(0, 80)]] });
      const { transformation } = crs;
      expect(transformation).toEqual(bytes.slice(0, 80));
      expect(transformation?.buffer.byteLength).toBe(80);
    });

    it("is read from an extended VLR where it is too long for another", async () => {
      const copc = await open({ records: [georeference], extended: [["groma", 3, bytes]] });
      expect(copc.crs.transformation).toEqual(bytes);
    });

    it("costs no request behind the points where no extended record can hold it", async () => {
      const blob = source(tinyCopc({ records: [georeference] }));
      const reads: number[] = [];
      const read: BlobSource["read"] = (begin, end, options) => {
        reads.push(begin);
        return blob.read(begin, end, options);
      };
      await openCopc(new KnownParts({ name: blob.name, size: blob.size, read }));
      // The root page, and nothing else.
      expect(reads.filter((begin) => begin > 700)).toHaveLength(1);
    });

    it("FORMAT_VLR where it is beyond reason, without reading it", async () => {
      const claimed = 17 * 1024 * 1024;
      const tiny = tinyCopc({ records: [georeference], extended: [["groma", 3, bytes, claimed]] });
      const blob = source(tiny);
      const size = tiny.length + claimed;
      const read: BlobSource["read"] = async (begin, end) => {
        expect(end - begin).toBeLessThanOrEqual(262_144);
        const there = new Uint8Array(end - begin);
        there.set(tiny.subarray(begin, end));
        return there;
      };
      await expect(openCopc(new KnownParts({ name: blob.name, size, read }))).rejects.toThrow(
        expect.objectContaining({ code: "FORMAT_VLR" }),
      );
    });

    it("FORMAT_TRUNCATED where it goes on beyond the file", async () => {
      const extended = [["groma", 3, bytes, 80_000]] as const;
      await expect(open({ records: [georeference], extended })).rejects.toThrow(
        expect.objectContaining({ code: "FORMAT_TRUNCATED" }),
      );
    });
  });

  it.each<[string, string, TinyCopc]>([
    ["FORMAT_MAGIC", "another format", { magic: "PK\x03\x04" }],
    ["FORMAT_NOT_COPC", "LAS 1.2", { minor: 2 }],
    ["FORMAT_NOT_COPC", "an uncompressed format", { formatByte: 7 }],
    ["FORMAT_NOT_COPC", "an old format", { formatByte: 0x83 }],
    ["FORMAT_EMPTY", "no points", { points: 0 }],
    ["FORMAT_HEADER", "records that are too short", { recordLength: 30 }],
    ["FORMAT_HEADER", "a scale of zero", { scale: 0 }],
    ["FORMAT_HEADER", "a scale that is no number", { scale: Number.NaN }],
    ["FORMAT_TRUNCATED", "a root page beyond the end", { pageOffset: 100_000 }],
    ["FORMAT_STATISTICS", "classes that are no numbers", { records: [["groma", 2, misnamed]] }],
    ["FORMAT_STATISTICS", "statistics that are no JSON", { records: [["groma", 2, Uint8Array.of(123, 34)]] }],
  ])("%s for %s", async (code, _, options) => {
    await expect(open(options)).rejects.toThrow(expect.objectContaining({ code }));
  });

  it("FORMAT_NOT_COPC for a whole file of LAS 1.2 that is shorter than a header of LAS 1.4", async () => {
    const short = tinyCopc({ minor: 2 }).slice(0, 227 + 20);
    await expect(openCopc(new KnownParts(source(short)))).rejects.toThrow(
      expect.objectContaining({ code: "FORMAT_NOT_COPC" }),
    );
  });

  it("FORMAT_TRUNCATED or FORMAT_MAGIC wherever the file is cut", async () => {
    const whole = tinyCopc();
    for (const length of [0, 3, 4, 200, 374, 480, 600, whole.length - 1]) {
      const error = await openCopc(new KnownParts(source(whole.subarray(0, length)))).catch(
        (thrown: unknown) => thrown,
      );
      expect(error, `cut at ${length}`).toBeInstanceOf(GromaError);
    }
  });

  it("throws nothing but its own errors whatever bytes are changed", async () => {
    const whole = tinyCopc({ wkt: 'PROJCS["x"]', records: [["groma", 2, statistics]] });
    const change = fc.tuple(fc.nat(whole.length - 1), fc.nat(255));
    await fc.assert(
      fc.asyncProperty(fc.array(change, { minLength: 1, maxLength: 8 }), async (changes) => {
        const bytes = whole.slice();
        for (const [at, value] of changes) bytes[at] = value;
        try {
          const copc = await CopcSource.open(source(bytes));
          for (const entry of await copc.page(copc.rootPage)) expect(entry.depth).toBeGreaterThanOrEqual(0);
        } catch (error) {
          expect(error).toBeInstanceOf(GromaError);
        }
      }),
      { numRuns: 300 },
    );
  });
});
