import { describe, expect, it } from "vitest";
import { packVertices, positionBox } from "./pack.js";
import { VERTEX_STRIDE } from "./protocol.js";
import { integerBox, type Records, readRecords } from "./records.js";

const records: Records = {
  count: 3,
  xyz: Int32Array.of(0, 0, -100, 5, -7, 0, 9, 9, 100),
  intensity: Uint16Array.of(0, 1000, 65535),
  rgb: Uint16Array.of(0, 128, 255, 256, 257, 65535, 1, 2, 3),
};
const positions = Float32Array.of(1, 2, 3, -4, 5, -6, 7, 8, 9.5);

function vertex(buffer: ArrayBuffer, index: number) {
  const view = new DataView(buffer, index * VERTEX_STRIDE, VERTEX_STRIDE);
  return {
    position: [0, 4, 8].map((at) => view.getFloat32(at, true)),
    colour: [12, 13, 14, 15].map((at) => view.getUint8(at)),
    intensity: view.getUint16(16, true),
    elevation: view.getUint16(18, true),
  };
}

describe("packVertices", () => {
  it("interleaves positions, colours, intensities and elevations", () => {
    const buffer = packVertices(positions, records, { rgbBits: 8, lowest: -100, highest: 100 });
    expect(buffer.byteLength).toBe(3 * VERTEX_STRIDE);
    expect(vertex(buffer, 0)).toEqual({
      position: [1, 2, 3],
      colour: [0, 128, 255, 255],
      intensity: 0,
      elevation: 0,
    });
    expect(vertex(buffer, 1)).toMatchObject({ position: [-4, 5, -6], intensity: 1000, elevation: 32768 });
    expect(vertex(buffer, 2)).toMatchObject({ colour: [1, 2, 3, 255], intensity: 65535, elevation: 65535 });
  });

  it("takes the upper byte of 16-bit colours", () => {
    const buffer = packVertices(positions, records, { rgbBits: 16, lowest: 0, highest: 1 });
    expect(vertex(buffer, 1).colour).toEqual([1, 1, 255, 255]);
  });

  it("is white without colours and level without heights", () => {
    const plain = { ...records, rgb: undefined };
    const buffer = packVertices(positions, plain, { rgbBits: 8, lowest: 5, highest: 5 });
    expect(vertex(buffer, 2)).toMatchObject({ colour: [255, 255, 255, 255], elevation: 0 });
  });

  it("holds heights outside the header's range at its ends", () => {
    const buffer = packVertices(positions, records, { rgbBits: 8, lowest: -50, highest: 50 });
    expect([0, 2].map((index) => vertex(buffer, index).elevation)).toEqual([0, 65535]);
  });
});

describe("boxes", () => {
  it("hold the least and greatest of each axis", () => {
    expect([...positionBox(positions)]).toEqual([-4, 2, -6, 7, 8, 9.5]);
    expect([...integerBox(records)]).toEqual([0, -7, -100, 9, 9, 100]);
  });

  it("hold the ends of the 32-bit range", () => {
    const xyz = Int32Array.of(-2147483648, 0, 2147483647);
    expect([...integerBox({ xyz, count: 1 })]).toEqual([...xyz, ...xyz]);
  });
});

describe("readRecords", () => {
  it("finds coordinates, intensity and colour among extra bytes", () => {
    const bytes = new Uint8Array(2 * 44);
    const view = new DataView(bytes.buffer, 44);
    for (const [at, value] of [
      [0, -5],
      [4, 6],
      [8, 7],
    ])
      view.setInt32(at, value, true);
    for (const [at, value] of [
      [12, 900],
      [30, 1],
      [32, 2],
      [34, 65535],
    ])
      view.setUint16(at, value, true);
    const { count, xyz, intensity, rgb } = readRecords(bytes, 7, 44);
    expect([count, ...xyz.subarray(3), intensity[1], ...(rgb?.subarray(3) ?? [])]).toEqual([
      2, -5, 6, 7, 900, 1, 2, 65535,
    ]);
  });
});
