import { expect, it } from "vitest";
import { exactTransform, greatestBound } from "../index.js";

const METRE = { name: "metre", kind: "linear", size: 1, declared: true } as const;
const height = { kind: "ellipsoidal" } as const;
const utm = exactTransform(
  { proj4: "+proj=utm +zone=33 +datum=WGS84", horizontalUnit: METRE, verticalUnit: METRE, height },
  0,
);
const box = (minX: number, edge: number) => {
  return { minX, minY: 5.5e6, minZ: 0, maxX: minX + edge, maxY: 5.5e6 + edge, maxZ: 100 };
};

it("is the tolerance, but for data sets in whose greatest node float32 costs more", () => {
  expect(greatestBound(utm, box(500_000, 1000), 0.001)).toBe(0.001);
  // ±100 km: half a unit in the last place is 2⁻⁸ m along two axes.
  expect(greatestBound(utm, box(400_000, 200_000), 0.001)).toBeGreaterThan(Math.SQRT2 * 2 ** -9);
  expect(greatestBound(utm, box(400_000, 200_000), 0.001)).toBeLessThan(0.01);
});

it("is the tolerance where part of the bounds has no place, which others say better", () => {
  expect(greatestBound(utm, box(1e9, 1e9), 0.002)).toBe(0.002);
});
