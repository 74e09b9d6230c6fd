import { describe, expect, it } from "vitest";
import { bufferPixel, nearestId, windowPixels } from "./pick-window.js";

/** A window of numbers as RGBA bytes. */
function pixels(rows: readonly (readonly number[])[]): Uint8Array {
  const numbers = new DataView(new ArrayBuffer(4 * rows.length ** 2));
  rows.flat().forEach((number, at) => {
    numbers.setUint32(4 * at, number, true);
  });
  return new Uint8Array(numbers.buffer);
}

describe("nearestId", () => {
  it("is the middle's, where there is one", () => {
    const rows = [
      [1, 2, 3],
      [4, 5, 6],
      [7, 8, 9],
    ];
    expect(nearestId(pixels(rows), 3)).toBe(5);
  });

  it("is that of the nearest pixel, a side before a corner", () => {
    const rows = [
      [1, 0, 0],
      [0, 0, 4_000_000_000],
      [0, 0, 2],
    ];
    expect(nearestId(pixels(rows), 3)).toBe(4_000_000_000);
  });

  it("is 0 where nothing is", () => expect(nearestId(new Uint8Array(4 * 25), 5)).toBe(0));
});

describe("windowPixels", () => {
  it.each([
    [1, 1, 1],
    [9, 1, 9],
    [9, 2, 19],
    [10, 1, 11],
    [7, 0.5, 5],
    [9, 1.5, 15],
    [1, 0.5, 1],
    [0, 1, 1],
  ])("%s CSS pixels at a ratio of %s are %s, an odd number", (css, ratio, expected) =>
    expect(windowPixels(css, ratio)).toBe(expected),
  );
});

describe("bufferPixel", () => {
  const canvas = { clientWidth: 200, clientHeight: 100 };
  it("counts rows from below", () => {
    expect(bufferPixel({ x: 0, y: 0 }, canvas, { width: 200, height: 100 })).toEqual({ x: 0, y: 99 });
    expect(bufferPixel({ x: 199.9, y: 99.9 }, canvas, { width: 200, height: 100 })).toEqual({ x: 199, y: 0 });
  });

  it("goes by the buffer's own size", () =>
    expect(bufferPixel({ x: 50, y: 25 }, canvas, { width: 400, height: 200 })).toEqual({ x: 100, y: 149 }));
});
