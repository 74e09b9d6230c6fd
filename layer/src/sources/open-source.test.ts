import { describe, expect, it } from "vitest";
import { BlobSource } from "./bytes/blob-source.js";
import { tinyCopc } from "./copc/tiny-copc.fixture.js";
import { openSource } from "./open-source.js";

const open = (content: Uint8Array | string) => openSource(new Blob([content as BlobPart]));
const failing = (code: string) => expect.objectContaining({ code });

describe("openSource", () => {
  it("tells what a data set says of itself, whatever its format", async () => {
    const source = await open(tinyCopc({ wkt: 'PROJCS["x"]' }));
    expect(source).toMatchObject({ name: "file", pointCount: 10, spacing: 1, crs: { wkt: 'PROJCS["x"]' } });
    expect(source.boundingBox).toEqual({ min: [0, 0, 0], max: [100, 100, 50] });
    expect(source.cube).toEqual([0, 0, 0, 100]);
    expect(source.attributes.slice(-3).map(({ name }) => name)).toEqual(["red", "green", "blue"]);
    expect(source.encoding).toMatchObject({ kind: "laz", pointFormat: 7, recordLength: 36, extraLength: 0 });
  });

  it("hands out pages and chunks by addresses that it alone understands", async () => {
    const bytes = tinyCopc();
    const source = await openSource(new BlobSource(new Blob([bytes.slice()])));
    const [root] = await source.page(source.rootPage);
    expect(root).toMatchObject({ depth: 0, pointCount: 10 });
    const chunk = await source.chunk(root.address);
    expect(chunk.bytes.byteLength).toBe(100);
  });

  it("has a spacing where the file has none", async () => {
    const bytes = tinyCopc();
    new DataView(bytes.buffer).setFloat64(429 + 32, 0, true);
    expect((await open(bytes)).spacing).toBe(100 / 128);
  });

  it("SOURCE_HTML for a web page, SOURCE_EMPTY for nothing, FORMAT_MAGIC for what it does not know", async () => {
    await expect(open(" <!doctype html><html>")).rejects.toThrow(failing("SOURCE_HTML"));
    await expect(open("PK\x03\x04 and more of an archive")).rejects.toThrow(failing("FORMAT_MAGIC"));
    await expect(open("")).rejects.toThrow(failing("SOURCE_EMPTY"));
  });
});
