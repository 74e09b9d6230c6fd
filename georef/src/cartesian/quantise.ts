import { PlacementError } from "../errors/errors.js";

const SMALLEST = -(2 ** 31);
const LARGEST = 2 ** 31 - 1;

/**
 * The integer of a LAS record that stands for a coordinate: coordinate = integer · scale + offset (LAS 1.4 R15, section
 * 2.6). Rounded to the nearest, because cutting off makes 28 of 0.29 / 0.01.
 *
 * @param file name for error messages
 * @throws PlacementError PLACE_RANGE where 32 bits do not hold it
 */
export function quantise(coordinate: number, scale: number, offset: number, file = "points"): number {
  const integer = Math.round((coordinate - offset) / scale);
  if (integer >= SMALLEST && integer <= LARGEST) return integer;
  throw new PlacementError({
    code: "PLACE_RANGE",
    file,
    cause: `the coordinate ${coordinate} does not fit into 32 bits with the scale ${scale} and the offset ${offset}`,
    fix: "take an offset near the points, or a coarser scale",
  });
}
