import { requireKind } from "../errors/arguments.js";
/**
 * Area of a polygon in the plane, signed: positive for vertices that run counter-clockwise. Loops of a ring that crosses
 * itself add up with their signs.
 *
 * The surveyor's formula (Meister 1769; Gauss) on differences to the first vertex: the differences of nearby coordinates
 * are exact, the products of coordinates of 10⁹ m are not (naive, a square metre there has the area 0).
 *
 * @param ring x, y of each vertex in turn, the first not repeated at the end
 * @returns in the square of the coordinates' unit
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function planarArea(ring: ArrayLike<number>): number {
  requireKind(ring, "numbers", "planarArea: ring");
  let sum = 0;
  let x0 = 0;
  let y0 = 0;
  for (let i = 2; i < ring.length; i += 2) {
    const x = ring[i] - ring[0];
    const y = ring[i + 1] - ring[1];
    sum += x0 * y - x * y0;
    x0 = x;
    y0 = y;
  }
  return sum / 2;
}
