import {
  type PointSource,
  type SourceBox,
  type SourceWarning,
  wrongBounds,
} from "../sources/contract/point-source.js";

/**
 * The box of all points of a data set, as far as it is known: the declared one, until a node is found to reach beyond it; from
 * then on the cube of the octree.
 */
export class SourceExtent {
  readonly #source: Pick<PointSource, "cube" | "scale">;
  #box: SourceBox;
  #warnings: readonly SourceWarning[];

  constructor(source: Pick<PointSource, "boundingBox" | "cube" | "scale" | "warnings">) {
    this.#source = source;
    this.#box = source.boundingBox;
    this.#warnings = source.warnings;
  }

  /** Source units. */
  get box(): SourceBox {
    return this.#box;
  }

  /** The data set's own warnings, and that of the box where it was found wrong. */
  get warnings(): readonly SourceWarning[] {
    return this.#warnings;
  }

  /**
   * Holds the points of a node against the box.
   * @param extent least x, y, z and greatest x, y, z of the node's points, source units
   * @returns whether the box is another one now
   */
  holdAgainst(extent: ArrayLike<number>): boolean {
    const { min, max } = this.#box;
    // Half of the last digit may be lost in the points and in the box.
    const beyond = this.#source.scale.some(
      (step, axis) => extent[axis] < min[axis] - 2 * step || extent[axis + 3] > max[axis] + 2 * step,
    );
    if (!beyond || this.#warnings.some(({ code }) => code === "BOUNDS_WRONG")) return false;
    const [x, y, z, edge] = this.#source.cube;
    this.#warnings = [...this.#warnings, wrongBounds(this.#box)];
    this.#box = { min: [x, y, z], max: [x + edge, y + edge, z + edge] };
    return true;
  }
}
