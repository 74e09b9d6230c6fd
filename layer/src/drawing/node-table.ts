import {
  CLIP_RECORDS,
  FIRST_ID,
  NODE_TABLE_WIDTH,
  type NodeLayout,
  type NodeValues,
  OCTREE_INDEX,
  placeIn,
  writeInteger,
  writeNode,
} from "../effects/index.js";
import type { DrawnNode } from "./drawn-node.js";
import type { Gpu, GpuTypes } from "./gpu.js";

/** What belongs to each of the nodes that are drawn together, as a texture that their programs read. */
export class NodeTable<T extends GpuTypes> {
  readonly #gpu: Gpu<T>;
  readonly #layout: NodeLayout;
  /** Where the values begin that each frame says anew. */
  readonly #firstId: number | undefined;
  readonly #octreeIndex: number | undefined;
  readonly #clipRecords: number | undefined;
  #data = new Float32Array(0);
  #texture: T["texture"] | undefined;

  constructor(gpu: Gpu<T>, layout: NodeLayout) {
    this.#gpu = gpu;
    this.#layout = layout;
    this.#firstId = placeIn(layout, FIRST_ID);
    this.#octreeIndex = placeIn(layout, OCTREE_INDEX);
    this.#clipRecords = placeIn(layout, CLIP_RECORDS);
  }

  /** Where a value begins in a row; undefined where programs read none of that name. */
  placeIn(name: string): number | undefined {
    return placeIn(this.#layout, name);
  }

  /** The rows, one after the other; another array once more rows are reserved. */
  get data(): Float32Array {
    return this.#data;
  }

  /** First component of a row. */
  beginOf(row: number): number {
    return 4 * this.#layout.texels * row;
  }

  /** Components of a row. */
  get width(): number {
    return 4 * this.#layout.texels;
  }

  /**
   * Writes a row of another array with these values, to be copied into the table as long as they hold; all others are 0.
   * @param step metres that the positions of its node are stored in
   */
  writeValues(rows: Float32Array, row: number, values: NodeValues, step: number | undefined): void {
    rows.fill(0, this.beginOf(row), this.beginOf(row + 1));
    writeNode(this.#layout, rows, row, values, step);
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

  /**
   * Writes a row but for what the view says of it.
   * @param rows where the values of the node stand, as {@link writeValues} writes them
   * @param from the row of these
   */
  write(row: number, rows: Float32Array, from: number, node: DrawnNode): void {
    const data = this.#data;
    const { width } = this;
    const begin = width * row;
    const first = width * from;
    for (let at = 0; at < width; at++) data[begin + at] = rows[first + at];
    // Programs count from the first vertex of the page.
    if (this.#firstId !== undefined) {
      writeInteger(data, begin + this.#firstId, node.firstId - node.uploaded.first);
    }
    if (this.#octreeIndex !== undefined) writeInteger(data, begin + this.#octreeIndex, node.octreeIndex);
    if (this.#clipRecords === undefined) return;
    const { clipRecords } = node;
    data[begin + this.#clipRecords] = clipRecords[0];
    data[begin + this.#clipRecords + 1] = clipRecords[1];
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
