import { describe, expect, it } from "vitest";
import { checkChunk } from "./chunk-layout.js";

/** A chunk of format 7 with two extra bytes: 12 layers of `sizes` bytes. */
function chunkOf(points: number, sizes: number[], recordLength = 38): Uint8Array {
  const bytes = new Uint8Array(
    recordLength + 4 + 4 * sizes.length + sizes.reduce((sum, size) => sum + size, 0),
  );
  const view = new DataView(bytes.buffer);
  view.setUint32(recordLength, points, true);
  for (const [layer, size] of sizes.entries()) view.setUint32(recordLength + 4 + 4 * layer, size, true);
  return bytes;
}

const sizes = [9, 8, 7, 6, 5, 4, 3, 2, 1, 20, 0, 3];
const encoding = { kind: "laz", pointFormat: 7, recordLength: 38, extraLength: 2, fields: [] } as const;
const check = (bytes: Uint8Array, pointCount = 10) =>
  checkChunk(bytes, encoding, { pointCount, file: "a.copc.laz", node: "0-0-0-0" });
const damaged = expect.objectContaining({ code: "DECODE_CHUNK" });

describe("checkChunk", () => {
  it("accepts a chunk whose layers add up", () => expect(() => check(chunkOf(10, sizes))).not.toThrow());

  it("refuses another number of points than the octree's", () =>
    expect(() => check(chunkOf(11, sizes))).toThrow(damaged));

  it("refuses a chunk that is cut, or too long", () => {
    const whole = chunkOf(10, sizes);
    for (const length of [0, 38, 80, whole.length - 1]) {
      expect(() => check(whole.subarray(0, length))).toThrow(damaged);
    }
    expect(() => check(new Uint8Array([...whole, 0]))).toThrow(damaged);
  });

  it("refuses layers that reach beyond the chunk", () => {
    const bytes = chunkOf(10, sizes);
    new DataView(bytes.buffer).setUint32(46, 0xffffffff, true);
    expect(() => check(bytes)).toThrow(damaged);
  });
});
