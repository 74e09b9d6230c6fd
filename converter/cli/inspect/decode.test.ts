import { LazModule } from "@groma/layer/query";
import { describe, expect, it, vi } from "vitest";
import { lazBytes } from "../files/laz.js";
import { decodeChunk } from "./decode.js";

const format = { pointFormat: 6, recordLength: 30 };

/** A chunk of ten records, each with its number for an intensity. */
async function someChunk(): Promise<{ chunk: Uint8Array; records: Uint8Array }> {
  const records = new Uint8Array(300);
  for (let index = 0; index < 10; index++) records.set([index + 1], 30 * index + 12);
  const module = await LazModule.load(await lazBytes());
  return { chunk: module.run("compress", { format: 6, extra: 0 }, records), records };
}

describe("decodeChunk", () => {
  it("gives the first records of a chunk", async () => {
    const { chunk, records } = await someChunk();
    expect(await decodeChunk(chunk, format, 10)).toEqual(records);
    expect(await decodeChunk(chunk, format, 3)).toEqual(records.slice(0, 90));
  });

  it("takes a fresh decoder after one that failed, which may be damaged as well, and no other", async () => {
    const { chunk, records } = await someChunk();
    await decodeChunk(chunk, format, 1);
    const load = vi.spyOn(LazModule, "load");
    await expect(decodeChunk(chunk.subarray(0, 40), format, 10)).rejects.toThrow("end too early");
    expect(load).not.toHaveBeenCalled();
    for (const _ of Array(3)) expect(await decodeChunk(chunk, format, 10)).toEqual(records);
    expect(load).toHaveBeenCalledOnce();
    load.mockRestore();
  });

  it("refuses records that are none", async () => {
    const none = { pointFormat: 6, recordLength: 29 };
    await expect(decodeChunk(new Uint8Array(8), none, 1)).rejects.toThrow(
      "there are no records of point format 6 with 29 bytes",
    );
  });
});
