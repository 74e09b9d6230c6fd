import { eastNorthUp, pointIn, type Vector } from "@groma/georef";
import type { MeasuredCloud } from "../vertex/vertex.js";

/** Source coordinates → metres east, metres north, metres of height. */
export type Plan = (x: number, y: number, z: number) => readonly [number, number, number];

/**
 * A plan about the middle of places, in their level; heights are those of the data set's own system. Linear: a projection
 * is so to 1e-6 over a kilometre.
 */
export function planOf(cloud: MeasuredCloud, corners: readonly Vector[]): Plan {
  const mean = [0, 1, 2].map(
    (axis) => corners.reduce((sum, corner) => sum + corner[axis], 0) / corners.length,
  );
  const reach = (axis: number) =>
    Math.max(1e-9, ...corners.map((corner) => Math.abs(corner[axis] - mean[axis])));
  const frame = eastNorthUp(cloud.place(mean[0], mean[1], mean[2]));
  const slope = (axis: 0 | 1) => {
    const step = reach(axis);
    const at = (sign: number) => {
      const [x, y] = axis === 0 ? [mean[0] + sign * step, mean[1]] : [mean[0], mean[1] + sign * step];
      const [X, Y, Z] = Array.from(cloud.place(x, y, mean[2]));
      return pointIn(frame, X, Y, Z);
    };
    const [ahead, behind] = [at(1), at(-1)];
    return [(ahead[0] - behind[0]) / (2 * step), (ahead[1] - behind[1]) / (2 * step)] as const;
  };
  const [ofX, ofY] = [slope(0), slope(1)];
  const unit = cloud.crs.verticalUnit.size;
  return (x, y, z) => {
    const [dx, dy] = [x - mean[0], y - mean[1]];
    return [ofX[0] * dx + ofY[0] * dy, ofX[1] * dx + ofY[1] * dy, z * unit];
  };
}
