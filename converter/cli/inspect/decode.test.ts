import { afterAll, beforeAll, beforeEach, describe, expect, it, vi } from "vitest";
import type { decodeChunk as DecodeChunk } from "./decode.js";

/** What stands for laz-perf: records of zeros, and a failure where the chunk begins with 255. */
const lazPerf = vi.hoisted(() => ({ modules: 0, allocated: 0, decoders: 0 }));

vi.mock("laz-perf/lib/node/index.js", () => ({
  create: async () => {
    lazPerf.modules++;
    const memory = new Uint8Array(1024);
    return {
      HEAPU8: memory,
      _malloc: () => 64 * lazPerf.allocated++,
      _free: () => lazPerf.allocated--,
      ChunkDecoder: class {
        constructor() {
          lazPerf.decoders++;
        }
        open(_format: number, _length: number, chunk: number) {
          if (memory[chunk] === 255) throw new Error("damaged");
        }
        getPoint() {}
        delete() {
          lazPerf.decoders--;
        }
      },
    };
  },
}));

describe("decodeChunk", () => {
  let decodeChunk: typeof DecodeChunk;

  // Files share their modules: neither may another's decoder serve here, nor this one there.
  beforeAll(async () => {
    vi.resetModules();
    ({ decodeChunk } = await import("./decode.js"));
  });
  afterAll(() => vi.resetModules());

  beforeEach(() => Object.assign(lazPerf, { modules: 0, allocated: 0, decoders: 0 }));

  it("decodes many chunks in one module and keeps nothing of them", async () => {
    const format = { pointFormat: 3, recordLength: 34 };
    for (let chunk = 0; chunk < 20; chunk++) {
      expect(await decodeChunk(new Uint8Array(8), format, 2)).toHaveLength(68);
    }
    expect(lazPerf).toEqual({ modules: 1, allocated: 0, decoders: 0 });
    // A module that failed may be damaged as well.
    await expect(decodeChunk(Uint8Array.of(255), format, 1)).rejects.toThrow("damaged");
    lazPerf.allocated = 0;
    await decodeChunk(new Uint8Array(8), format, 1);
    expect(lazPerf.modules).toBe(2);
  });

  it("refuses point formats that it does not know", async () => {
    await expect(decodeChunk(new Uint8Array(8), { pointFormat: 9, recordLength: 59 }, 1)).rejects.toThrow(
      "point format 9 cannot be decoded",
    );
    expect(lazPerf.modules).toBe(0);
  });
});
