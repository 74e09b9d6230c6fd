import { eastNorthUp } from "../ellipsoid/frame.js";
import { FLOOR, halfUlp32 } from "./certificate.js";
import type { Placement } from "./placement.js";

/**
 * A placement whose frame stands amid the points themselves, where no fit is used and the middle of the domain is so far from
 * them that float32 costs more than the tolerance: points on both sides of 180° are neighbours, but their longitudes are not.
 * Elsewhere the placement as it is.
 *
 * @param xyz x, y, z of each record, 3 · count integers
 * @param scale LAS scale factors, 3 values, source units
 * @param offset LAS offsets, 3 values, source units
 * @param frameAt the frame that a node is placed in, as for {@link fitPlacement}
 */
export function aroundPoints(
  placement: Placement,
  { xyz, count }: { readonly xyz: Int32Array; readonly count: number },
  scale: ArrayLike<number>,
  offset: ArrayLike<number>,
  toleranceMetres: number,
  frameAt = eastNorthUp,
): Placement {
  const { exact, storageBound, fitBound } = placement;
  if (!exact || storageBound <= toleranceMetres || count === 0) return placement;
  const least = new Float64Array(3).fill(Number.POSITIVE_INFINITY);
  const greatest = new Float64Array(3).fill(Number.NEGATIVE_INFINITY);
  const place = new Float64Array(3);
  for (let i = 0; i < 3 * count; i += 3) {
    exact(
      xyz[i] * scale[0] + offset[0],
      xyz[i + 1] * scale[1] + offset[1],
      xyz[i + 2] * scale[2] + offset[2],
      place,
      0,
    );
    for (let axis = 0; axis < 3; axis++) {
      least[axis] = Math.min(least[axis], place[axis]);
      greatest[axis] = Math.max(greatest[axis], place[axis]);
    }
  }
  const middle = [0, 1, 2].map((axis) => (least[axis] + greatest[axis]) / 2);
  const reach = Math.hypot(...[0, 1, 2].map((axis) => (greatest[axis] - least[axis]) / 2)) + FLOOR;
  const storage = Math.sqrt(3) * halfUlp32(reach);
  if (!(storage < storageBound)) return placement;
  return { ...placement, frame: frameAt(middle), storageBound: storage, bound: fitBound + storage };
}
