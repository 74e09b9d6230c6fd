import type { BoxRelation, QueryVolume } from "../../query/index.js";

/** All between two heights, both included: a floor plan, a slice of a stockpile; of another volume, or of everything. */
export class SliceVolume implements QueryVolume {
  readonly #low: number;
  readonly #high: number;
  readonly #of: QueryVolume | undefined;

  /**
   * @param low source z, in its unit
   * @param high not below it
   * @param of the volume that is sliced. Default: everything
   * @throws RangeError where the heights are none
   */
  constructor(low: number, high: number, of?: QueryVolume) {
    if (!(low <= high)) throw new RangeError(`there is nothing between the heights ${low} and ${high}`);
    this.#low = low;
    this.#high = high;
    this.#of = of;
  }

  toBox(box: Float64Array): BoxRelation {
    if (box[2] > this.#high || box[5] < this.#low) return "out";
    const relation = this.#of?.toBox(box) ?? "in";
    return relation === "in" && !(box[2] >= this.#low && box[5] <= this.#high) ? "crossing" : relation;
  }

  contains(x: number, y: number, z: number): boolean {
    return z >= this.#low && z <= this.#high && (this.#of?.contains(x, y, z) ?? true);
  }
}
