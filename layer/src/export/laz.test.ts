import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { LazModule } from "../laz/index.js";
import { MemorySink } from "./byte-sink.js";
import { LazWorker, type LazWorkerLike, type PointCompressor } from "./compressor/laz-worker.js";
import { exportLas } from "./las.js";
import { exportLaz } from "./laz.js";
import { scanOf } from "./scan.fixture.js";

const built = join(
  import.meta.dirname,
  "../../../converter/wasm/target/wasm32-unknown-unknown/release/groma_laz.wasm",
);

/** The compressor on this thread. */
async function inProcess(): Promise<PointCompressor> {
  const module = await LazModule.load(readFileSync(built));
  return { run: async (task, layout, input) => module.run(task, layout, input), close: () => undefined };
}

describe("LAZ from recorded points", () => {
  it("is LAS compressed: its front and what the record of LASzip adds, chunks, and a table that leads to them", async () => {
    const points = Array.from({ length: 120_000 }, (_, index) => ({
      xyz: [index, 2 * index, index % 100] as const,
      colour: [index % 256, 5, 6] as const,
    }));
    const scan = scanOf(points, 7000);
    const [plain, packed] = [new MemorySink(), new MemorySink()];
    await exportLas([{ origin: scan }], plain);
    const compressor = await inProcess();
    expect(await exportLaz([{ origin: scan }], packed, { createCompressor: () => compressor })).toBe(120_000);
    const [las, laz] = [plain.bytes(), packed.bytes()];
    expect(laz.length).toBeLessThan(las.length / 4);
    const view = new DataView(laz.buffer);
    const begin = view.getUint32(96, true);
    expect([view.getUint8(104), view.getUint32(100, true)]).toEqual([0x87, 1]);
    expect(Buffer.compare(laz.subarray(105, 375), las.subarray(105, 375))).toBe(0);
    expect(new TextDecoder().decode(laz.subarray(377, 391))).toBe("laszip encoded");
    const table = Number(view.getBigUint64(begin, true));
    // Version 0, three chunks.
    expect([view.getUint32(table, true), view.getUint32(table + 4, true)]).toEqual([0, 3]);
    // Each chunk begins with its first record as it is.
    expect(Buffer.compare(laz.subarray(begin + 8, begin + 44), las.subarray(375, 411))).toBe(0);
  });

  it("refuses what is no layout", async () => {
    const module = await LazModule.load(readFileSync(built));
    expect(() => module.run("describe", { format: 3, extra: 0 }, new Uint8Array(0))).toThrow(RangeError);
    expect(() => module.run("compress", { format: 6, extra: 0 }, new Uint8Array(31))).toThrow(RangeError);
  });
});

describe("the worker that compresses", () => {
  const layout = { format: 6, extra: 0 };

  it("is told of by its code where it dies, and its own failures come as they are", async () => {
    const fake: LazWorkerLike = {
      postMessage: () => undefined,
      terminate: () => undefined,
      onmessage: null,
      onerror: null,
    };
    const worker = new LazWorker(fake);
    const [first, second] = [0, 1].map(() => worker.run("compress", layout, new Uint8Array(0)));
    const fault = { kind: "FormatError", code: "EXPORT_NO_LAZ", file: "a", cause: "b", fix: "c" };
    fake.onmessage?.({ data: { id: 0, fault } } as never);
    await expect(first).rejects.toMatchObject({ code: "EXPORT_NO_LAZ", file: "a" });
    fake.onerror?.({ message: "", preventDefault: () => undefined } as never);
    await expect(second).rejects.toMatchObject({ code: "EXPORT_NO_LAZ", file: "laz.worker.js" });
  });

  it("is ended with the export, whatever becomes of it", async () => {
    let ended = 0;
    const createCompressor = () => ({
      run: () => Promise.reject(new Error("no")),
      close: () => void ended++,
    });
    await expect(
      exportLaz([{ origin: scanOf([{ xyz: [0, 0, 0] }]) }], new MemorySink(), { createCompressor }),
    ).rejects.toThrow("no");
    expect(ended).toBe(1);
  });
});
