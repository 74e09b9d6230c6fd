import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { PointCloud } from "@groma/layer";
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

    const lion = data("lion_takanawa.copc.laz");
    const lionSkipped = lion.missing ? ` (skipped: ${lion.missing})` : "";
    it.skipIf(lion.missing)(
      `CRS_MISSING: it names no CRS, until the user gives one${lionSkipped}`,
      async () => {
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
      },
    );

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

    // LAZ has no checksum: what still describes itself rightly, lasts to the last point and stays inside of its node cannot
    // be told from a scan.
    it.each([
      ["x of the first point", 3, 0x7f, "they lie outside their node"],
      ["its number of points", 44, 0xff, "it holds 66303 points, the octree says 66272"],
      ["the size of a layer", 60, 0xff, "it describes 528665 bytes, the octree says 528632"],
      ["compressed coordinates", 1000, 0x01, "the compressed points end too early"],
      ["compressed attributes", 264_316, 0x5a, "the compressed points end too early"],
    ])("DECODE_CHUNK: %s is changed", async (_, at, value, cause) => {
      const cloud = await open(patched(rootChunk().offset + at, value));
      await expect(cloud.loadNode("0-0-0-0")).rejects.toThrow(
        expect.objectContaining({ code: "DECODE_CHUNK", cause: expect.stringContaining(cause) }),
      );
      cloud.destroy();
    });

    it("leaves positions as they are where the intensity of the first point is changed", async () => {
      const [sound, changed] = [await open(whole), await open(patched(rootChunk().offset + 12, 0xff))];
      const [before, after] = [await sound.loadNode("0-0-0-0"), await changed.loadNode("0-0-0-0")];
      expect(after.count).toBe(66_272);
      expect(after.positions).toEqual(before.positions);
      sound.destroy();
      changed.destroy();
    });
  },
);

const variantsMissing = existsSync(variants) ? "" : " (skipped: las-variants is not in ../shared/data)";
describe.skipIf(variantsMissing)(`odd and broken files of other tools${variantsMissing}`, () => {
  const names = variantsMissing ? [] : readdirSync(variants).filter((name) => /\.(las|laz|e57)$/.test(name));
  const codeOf = (name: string) => (name.endsWith(".e57") ? "FORMAT_MAGIC" : "FORMAT_NOT_COPC");

  it.each(names.filter((name) => !name.endsWith(".copc.laz")).map((name) => [codeOf(name), name]))(
    "%s: %s",
    async (code, name) => {
      await expect(open(new Uint8Array(readFileSync(join(variants, name))))).rejects.toThrow(coded(code));
    },
  );

  it.each(names.filter((name) => name.endsWith(".copc.laz")))("%s opens", async (name) => {
    const cloud = await open(new Uint8Array(readFileSync(join(variants, name))));
    expect(cloud.pointCount).toBeGreaterThan(0);
    cloud.destroy();
  });
});
