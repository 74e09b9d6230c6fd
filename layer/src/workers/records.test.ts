import { describe, expect, it } from "vitest";
import { integerBox, positionBox, readCoordinates } from "./records.js";

describe("boxes", () => {
  it("hold the least and greatest of each axis", () => {
    expect([...positionBox(Float32Array.of(1, 2, 3, -4, 5, -6, 7, 8, 9.5))]).toEqual([-4, 2, -6, 7, 8, 9.5]);
    expect([...integerBox(Int32Array.of(0, 0, -100, 5, -7, 0, 9, 9, 100))]).toEqual([0, -7, -100, 9, 9, 100]);
  });

  it("hold the ends of the 32-bit range", () => {
    const xyz = Int32Array.of(-2147483648, 0, 2147483647);
    expect([...integerBox(xyz)]).toEqual([...xyz, ...xyz]);
  });
});

describe("readCoordinates", () => {
  it("finds coordinates among other bytes", () => {
    const bytes = new Uint8Array(2 * 44 + 3).fill(255);
    const view = new DataView(bytes.buffer, 3);
    for (const [index, value] of [-5, 6, 7].entries()) view.setInt32(44 + 4 * index, value, true);
    expect([...readCoordinates(bytes.subarray(3), 44)]).toEqual([-1, -1, -1, -5, 6, 7]);
  });
});
