import { NODE_TABLE_WIDTH, type NodeLayout, type NodeValues, writeNode } from "../effects/index.js";
import type { Gpu, GpuTypes } from "./gpu.js";

/** What belongs to each of the nodes that are drawn together, as a texture that their programs read. */
export class NodeTable<T extends GpuTypes> {
  readonly #gpu: Gpu<T>;
  readonly #layout: NodeLayout;
  #data = new Float32Array(0);
  #texture: T["texture"] | undefined;

  constructor(gpu: Gpu<T>, layout: NodeLayout) {
    this.#gpu = gpu;
    this.#layout = layout;
  }

  /** Makes room for so many rows, which are all to be written then. */
  reserve(rows: number): void {
    const lines = Math.max(1, Math.ceil((rows * this.#layout.texels) / NODE_TABLE_WIDTH));
    // Twice as many where there are too few: the number of nodes changes with each step of the camera.
    const height = 2 ** Math.ceil(Math.log2(lines));
    if (4 * NODE_TABLE_WIDTH * height > this.#data.length) {
      this.#data = new Float32Array(4 * NODE_TABLE_WIDTH * height);
    }
  }

  /** Values of a row; those not named stay. @param step metres that the positions of its node are stored in */
  write(row: number, values: NodeValues, step: number | undefined): void {
    writeNode(this.#layout, this.#data, row, values, step);
  }

  /** The table as it was written. */
  upload(): T["texture"] {
    const height = this.#data.length / 4 / NODE_TABLE_WIDTH;
    const texels = { width: NODE_TABLE_WIDTH, height, data: this.#data };
    if (this.#texture?.height === height) this.#gpu.writeTexture(this.#texture, texels);
    else {
      this.#gpu.free(this.#texture);
      this.#texture = this.#gpu.dataTexture(texels);
    }
    return this.#texture;
  }

  destroy(): void {
    this.#gpu.free(this.#texture);
    this.#texture = undefined;
  }
}
