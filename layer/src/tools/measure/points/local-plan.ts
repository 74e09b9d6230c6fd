import { eastNorthUp, pointIn, type Vector } from "@groma/georef";
import type { MeasuredCloud } from "../vertex/vertex.js";

/** How source coordinates are put into a plan: metres east, metres north, metres of height. */
export class Plan {
  readonly #middle: readonly [number, number];
  /** Metres east and north of a source unit of x, and of y. */
  readonly #ofX: readonly [number, number];
  readonly #ofY: readonly [number, number];
  readonly #unit: number;

  /**
   * A plan about the middle of places, in their level; heights are those of the data set's own system. Linear: a projection
   * is so to 1e-6 over a kilometre.
   */
  constructor(cloud: MeasuredCloud, corners: readonly Vector[]) {
    const mean = [0, 1, 2].map(
      (axis) => corners.reduce((sum, corner) => sum + corner[axis], 0) / corners.length,
    );
    const frame = eastNorthUp(cloud.place(mean[0], mean[1], mean[2]));
    // Nowhere but between the corners: beside a data set there may be no places.
    const slope = (axis: 0 | 1) => {
      const along = corners.map((corner) => corner[axis]);
      const at = (value: number) => {
        const [x, y] = axis === 0 ? [value, mean[1]] : [mean[0], value];
        const [X, Y, Z] = Array.from(cloud.place(x, y, mean[2]));
        return pointIn(frame, X, Y, Z);
      };
      const [low, high] = [Math.min(...along), Math.max(...along)];
      if (low === high) return [0, 0] as const;
      const [ahead, behind] = [at(high), at(low)];
      return [(ahead[0] - behind[0]) / (high - low), (ahead[1] - behind[1]) / (high - low)] as const;
    };
    this.#middle = [mean[0], mean[1]];
    this.#ofX = slope(0);
    this.#ofY = slope(1);
    this.#unit = cloud.crs.verticalUnit.size;
  }

  /** Puts places into the plan, in place. @param xyz x, y, z of each in turn, source units; metres afterwards */
  take(xyz: Float64Array): Float64Array {
    const [middleX, middleY] = this.#middle;
    const [eastX, northX] = this.#ofX;
    const [eastY, northY] = this.#ofY;
    const unit = this.#unit;
    for (let at = 0; at < xyz.length; at += 3) {
      const x = xyz[at] - middleX;
      const y = xyz[at + 1] - middleY;
      xyz[at] = eastX * x + eastY * y;
      xyz[at + 1] = northX * x + northY * y;
      xyz[at + 2] *= unit;
    }
    return xyz;
  }
}
