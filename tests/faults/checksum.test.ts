import { readFileSync } from "node:fs";
import { PointCloud } from "@groma/layer";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { coreMissing } from "../interop/core.js";
import { data } from "../project.js";
import { localExecutor } from "./local-executor.js";

const scan = data("vol_total.laz");
const missing = coreMissing ?? scan.missing;

interface Chunk {
  readonly node: string;
  readonly offset: number;
  readonly length: number;
}

/** The chunks of a file whose hierarchy is one page. */
function chunksOf(bytes: Uint8Array): Chunk[] {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const page = Number(view.getBigUint64(469, true));
  const end = page + Number(view.getBigUint64(477, true));
  const chunks: Chunk[] = [];
  for (let at = page; at < end; at += 32) {
    const node = [0, 4, 8, 12].map((field) => view.getInt32(at + field, true)).join("-");
    const [offset, length] = [Number(view.getBigUint64(at + 16, true)), view.getInt32(at + 24, true)];
    if (view.getInt32(at + 28, true) > 0) chunks.push({ node, offset, length });
  }
  return chunks;
}

describe.skipIf(missing)(
  `a converted file with a damaged byte${missing ? ` (skipped: ${missing})` : ""}`,
  () => {
    it("neither draws nor tells points of the node, whichever byte of whichever chunk it is", {
      timeout: 120_000,
    }, async () => {
      const whole = new Uint8Array(readFileSync(converted(scan.path)));
      const chunks = chunksOf(whole);
      const place = fc.record({
        chunk: fc.constantFrom(...chunks),
        share: fc.double({ min: 0, max: 1, noNaN: true }),
      });
      await fc.assert(
        fc.asyncProperty(place, fc.integer({ min: 1, max: 255 }), async ({ chunk, share }, change) => {
          const bytes = whole.slice();
          const at = chunk.offset + Math.min(chunk.length - 1, Math.floor(share * chunk.length));
          bytes[at] ^= change;
          const cloud = await PointCloud.fromUrl(new Blob([bytes]), { executor: localExecutor() });
          const damaged = expect.objectContaining({
            code: "DECODE_CHECKSUM",
            cause: expect.stringContaining(`node ${chunk.node} `),
          });
          await expect(cloud.loadNode(chunk.node)).rejects.toThrow(damaged);
          await expect(cloud.readPoint(chunk.node, 0)).rejects.toThrow(damaged);
          cloud.destroy();
        }),
        { numRuns: 60 },
      );
    });
  },
);
