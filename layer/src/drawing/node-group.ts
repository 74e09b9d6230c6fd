import { type EffectPlan, NODE_NUMBER, NODE_TABLE, type NodeValues, nodeLayoutOf } from "../effects/index.js";
import type { OctreeNode } from "../octree/index.js";
import type { DrawnNode, DrawnWith, ViewTypes } from "./drawn-node.js";
import type { Gpu } from "./gpu.js";
import { NodeTable } from "./node-table.js";
import { type FrameGround, sameGround } from "./still-frame.js";

/** Nodes that are drawn with the same effects, by the same program in each pass: what tells them apart is in a table. */
export class NodeGroup<V extends ViewTypes> implements DrawnWith<V> {
  /** Uniforms of all of them, the table among them. */
  readonly uniforms: V["uniforms"];
  readonly #table: NodeTable<V>;
  #plan: EffectPlan;
  #nodes: readonly DrawnNode<V>[] = [];
  #values: readonly NodeValues[] = [];
  /** What the table on the GPU was written for. */
  #placed: FrameGround | undefined;

  /** @param base uniforms of the layer */
  constructor(gpu: Gpu<V>, plan: EffectPlan, base: V["uniforms"]) {
    this.#plan = plan;
    this.#table = new NodeTable(gpu, nodeLayoutOf(plan, gpu.target));
    this.uniforms = gpu.uniforms(base);
    this.uniforms.set({ [NODE_NUMBER]: 0 });
  }

  /** The effects that they are drawn with. */
  get plan(): EffectPlan {
    return this.#plan;
  }

  get rows(): number {
    return this.#values.length;
  }

  /** Those of the last frame that are still there, by rising row; the same array until they, or their places, are others. */
  get nodes(): readonly DrawnNode<V>[] {
    return this.#nodes;
  }

  /**
   * Takes the nodes of a frame; the row of each is its index.
   * @param plan one with the same key
   * @param values what the effects say of each node
   */
  take(plan: EffectPlan, nodes: readonly DrawnNode<V>[], values: readonly NodeValues[]): void {
    this.#plan = plan;
    this.#nodes = nodes;
    this.#values = values;
  }

  /** Draws a node no more; the rows of the others stay. */
  forget(node: OctreeNode): void {
    this.#nodes = this.#nodes.filter((drawn) => drawn.node !== node);
  }

  /** The nodes are drawn at other places from now on. */
  replace(): void {
    this.#nodes = [...this.#nodes];
  }

  /**
   * Says where the nodes are drawn, and puts the table on the GPU where it is not there already.
   * @param copies how often each is drawn: row `copy · nodes + index` is that of a copy
   * @param by what all places follow from besides the nodes: numbers, and objects that never change
   * @param place what the view says of a copy of a node: its matrices
   */
  place(
    copies: number,
    by: readonly unknown[],
    place: (node: DrawnNode<V>, copy: number) => NodeValues,
  ): void {
    const ground = [this.#nodes, copies, ...by];
    if (sameGround(ground, this.#placed)) return;
    this.#placed = ground;
    this.#table.reserve(copies * this.rows);
    for (let copy = 0; copy < copies; copy++) {
      for (const node of this.#nodes) {
        const row = copy * this.rows + node.row;
        const { step } = node.uploaded.vertices;
        this.#table.write(row, this.#values[node.row], step);
        this.#table.write(row, place(node, copy), step);
      }
    }
    this.uniforms.setTexture(NODE_TABLE, this.#table.upload());
  }

  destroy(): void {
    this.#table.destroy();
  }
}
