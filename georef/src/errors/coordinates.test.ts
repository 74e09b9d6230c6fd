import { expect, it } from "vitest";
import { boundsInWords, coordinate } from "./coordinates.js";

it("coordinates in messages have no digits of their binary form", () => {
  expect([580000.4100000001, 0.1 + 0.2, -123.07, 5400000, Number.NaN].map(coordinate)).toEqual([
    ...["580000.41", "0.3", "-123.07", "5400000", "NaN"],
  ]);
  const plane = { minX: 0.1 + 0.2, minY: 1, maxX: 2, maxY: 3 };
  expect(boundsInWords(plane)).toBe("x 0.3 … 2, y 1 … 3");
  expect(boundsInWords({ ...plane, minZ: -1, maxZ: 4 })).toBe("x 0.3 … 2, y 1 … 3, z -1 … 4");
});
