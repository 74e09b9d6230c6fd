import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { GromaError } from "@groma/georef";
import { PointCloud } from "@groma/layer";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { data, dataFolder } from "../project.js";
import { localExecutor } from "./local-executor.js";

const scan = data("ellipsoid.copc.laz");
const whole = scan.missing ? new Uint8Array() : new Uint8Array(readFileSync(scan.path));
const variants = join(dataFolder, "las-variants");

const open = (bytes: Uint8Array, options = {}) =>
  PointCloud.fromUrl(new Blob([bytes.slice()]), { executor: localExecutor(), ...options });
const coded = (code: string) => expect.objectContaining({ code });

/** A copy with bytes written over. */
function patched(at: number, ...bytes: number[]): Uint8Array {
  const copy = whole.slice();
  copy.set(bytes, at);
  return copy;
}

/** First byte and length of the root's chunk, from the hierarchy. */
function rootChunk(): { offset: number; length: number } {
  const view = new DataView(whole.buffer);
  const page = Number(view.getBigUint64(469, true));
  const pages = Number(view.getBigUint64(477, true));
  for (let at = page; at < page + pages; at += 32) {
    if (view.getInt32(at, true) !== 0) continue;
    return { offset: Number(view.getBigUint64(at + 16, true)), length: view.getInt32(at + 24, true) };
  }
  throw new Error("no root");
}

describe.skipIf(scan.missing)(
  `a file that is damaged${scan.missing ? ` (skipped: ${scan.missing})` : ""}`,
  () => {
    it.each<[string, string, () => Uint8Array]>([
      ["FORMAT_MAGIC", "it is something else", () => patched(0, 0x50, 0x4b)],
      ["FORMAT_TRUNCATED", "it is cut in its header", () => whole.subarray(0, 300)],
      ["FORMAT_TRUNCATED", "it is cut in its points", () => whole.subarray(0, 600_000)],
      ["FORMAT_TRUNCATED", "it is cut in its hierarchy", () => whole.subarray(0, whole.length - 1)],
      ["FORMAT_EMPTY", "it has no points", () => patched(247, 0, 0, 0, 0, 0, 0, 0, 0)],
      ["FORMAT_NOT_COPC", "it has no octree", () => patched(375 + 2, 0x78)],
      ["FORMAT_HIERARCHY", "its root page is empty", () => patched(477, 0, 0, 0, 0)],
    ])("%s: %s", async (code, _, bytes) => {
      await expect(open(bytes())).rejects.toThrow(coded(code));
    });

    it("CRS_MISSING: it does not say where it is, until the user does", async () => {
      const lion = data("lion_takanawa.copc.laz");
      if (lion.missing) return;
      const bytes = new Uint8Array(readFileSync(lion.path));
      await expect(open(bytes)).rejects.toThrow(coded("CRS_MISSING"));
      const cloud = await open(bytes, { crs: "+proj=utm +zone=54 +datum=WGS84 +units=m" });
      expect([cloud.basis, cloud.height.kind]).toEqual(["given", "unknown"]);
      expect(cloud.accuracy.parts.map((part) => part.name)).toEqual([
        "quantisation",
        "fit",
        "datum operation",
        "height",
      ]);
      cloud.destroy();
    });

    it("DECODE_CHUNK: a node's points are damaged, the others are not", async () => {
      const { offset } = rootChunk();
      const cloud = await open(patched(offset + 44, 1, 2, 3, 4));
      await expect(cloud.loadNode("0-0-0-0")).rejects.toThrow(coded("DECODE_CHUNK"));
      expect((await cloud.loadNode("1-0-0-0")).count).toBeGreaterThan(0);
      cloud.destroy();
    });

    it("FORMAT_NODE: a node that the octree does not have", async () => {
      const cloud = await open(whole);
      for (const key of ["9-0-0-0", "nonsense"]) {
        await expect(cloud.loadNode(key)).rejects.toThrow(coded("FORMAT_NODE"));
      }
      cloud.destroy();
    });

    it("decodes any changed chunk to points inside its node, or says that it is damaged", async () => {
      const { offset, length } = rootChunk();
      const change = fc.tuple(fc.nat(length - 1), fc.nat(255));
      await fc.assert(
        fc.asyncProperty(fc.array(change, { minLength: 1, maxLength: 3 }), async (changes) => {
          const bytes = whole.slice();
          for (const [at, value] of changes) bytes[offset + at] = value;
          const cloud = await open(bytes);
          try {
            const { count, box } = await cloud.loadNode("0-0-0-0");
            expect(count).toBe(66272);
            expect(box.every((value) => Math.abs(value) < 1000)).toBe(true);
          } catch (error) {
            expect(error).toBeInstanceOf(GromaError);
          } finally {
            cloud.destroy();
          }
        }),
        { numRuns: 12 },
      );
    });
  },
);

describe.skipIf(!existsSync(variants))("odd and broken files of other tools", () => {
  it("open, or fail with an error of their own", async () => {
    const names = readdirSync(variants).filter((name) => /\.(las|laz|e57)$/.test(name));
    expect(names.length).toBeGreaterThan(10);
    for (const name of names) {
      const bytes = new Uint8Array(readFileSync(join(variants, name)));
      const result = await open(bytes).catch((thrown: unknown) => thrown);
      if (result instanceof PointCloud) result.destroy();
      else expect(result, name).toBeInstanceOf(GromaError);
    }
  });
});
