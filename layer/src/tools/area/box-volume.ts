import type { BoxRelation, QueryVolume } from "../../query/index.js";

/** An upright box in source coordinates; its sides belong to it. */
export class BoxVolume implements QueryVolume {
  readonly #min: readonly number[];
  readonly #max: readonly number[];

  /**
   * @param min least x, y, z; −∞ for an open side
   * @param max greatest x, y, z; ∞ for an open side
   * @throws RangeError where a least value is not below the greatest one
   */
  constructor(min: readonly [number, number, number], max: readonly [number, number, number]) {
    if (!min.every((least, axis) => least <= max[axis])) {
      throw new RangeError("a least coordinate of the box is above the greatest one");
    }
    this.#min = min;
    this.#max = max;
  }

  contains(x: number, y: number, z: number): boolean {
    const [minX, minY, minZ] = this.#min;
    const [maxX, maxY, maxZ] = this.#max;
    return x >= minX && x <= maxX && y >= minY && y <= maxY && z >= minZ && z <= maxZ;
  }

  toBox(box: Float64Array): BoxRelation {
    let relation: BoxRelation = "in";
    for (let axis = 0; axis < 3; axis++) {
      if (box[axis] > this.#max[axis] || box[axis + 3] < this.#min[axis]) return "out";
      if (box[axis] < this.#min[axis] || box[axis + 3] > this.#max[axis]) relation = "crossing";
    }
    return relation;
  }
}
