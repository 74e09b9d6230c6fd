import fc from "fast-check";
import { expect, it } from "vitest";
import { BoxVolume } from "./box-volume.js";
import { SliceVolume } from "./slice-volume.js";

const number = fc.integer({ min: -8, max: 8 }).map((steps) => steps / 2);
const place = fc.tuple(number, number, number);

it("a slice contains what is between its heights in what is sliced, and boxes never say otherwise", () => {
  const least = [-2, -2, -4] as const;
  const greatest = [3, 2, 3] as const;
  fc.assert(
    fc.property(number, number, fc.boolean(), place, place, place, (a, b, boxed, one, other, point) => {
      const [low, high] = [Math.min(a, b), Math.max(a, b)];
      const slice = new SliceVolume(low, high, boxed ? new BoxVolume(least, greatest) : undefined);
      const [x, y, z] = point;
      const within = point.every((value, axis) => value >= least[axis] && value <= greatest[axis]);
      const expected = z >= low && z <= high && (!boxed || within);
      expect(slice.contains(x, y, z)).toBe(expected);
      const box = Float64Array.from([
        ...one.map((value, axis) => Math.min(value, other[axis])),
        ...one.map((value, axis) => Math.max(value, other[axis])),
      ]);
      if (point.some((value, axis) => value < box[axis] || value > box[axis + 3])) return;
      const relation = slice.toBox(box);
      if (relation === "in") expect(expected).toBe(true);
      if (relation === "out") expect(expected).toBe(false);
    }),
  );
  expect(new SliceVolume(1, 2).toBox(Float64Array.of(0, 0, 1, 9, 9, 2))).toBe("in");
  expect(() => new SliceVolume(2, 1)).toThrow("nothing between the heights 2 and 1");
  expect(() => new SliceVolume(Number.NaN, 1)).toThrow(RangeError);
});
