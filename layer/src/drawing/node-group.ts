import { type EffectPlan, NODE_NUMBER, NODE_TABLE, type NodeValues, nodeLayoutOf } from "../effects/index.js";
import type { DrawnNode, DrawnWith, ViewTypes } from "./drawn-node.js";
import type { Gpu } from "./gpu.js";
import { NodeTable } from "./node-table.js";

/** Nodes that are drawn with the same effects, by the same program in each pass: what tells them apart is in a table. */
export class NodeGroup<V extends ViewTypes> implements DrawnWith<V> {
  /** Uniforms of all of them, the table among them. */
  readonly uniforms: V["uniforms"];
  readonly #table: NodeTable<V>;
  #plan: EffectPlan;
  #nodes: readonly DrawnNode<V>[] = [];
  #values: readonly NodeValues[] = [];

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
    return this.#nodes.length;
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

  /**
   * Says where the nodes are drawn, and puts the table on the GPU.
   * @param copies how often each is drawn: row `copy · nodes + index` is that of a copy
   * @param place what the view says of a copy of a node: its matrices
   */
  place(copies: number, place: (node: DrawnNode<V>, copy: number) => NodeValues): void {
    const nodes = this.#nodes;
    this.#table.reserve(copies * nodes.length);
    for (let copy = 0; copy < copies; copy++) {
      for (let index = 0; index < nodes.length; index++) {
        const row = copy * nodes.length + index;
        this.#table.write(row, this.#values[index]);
        this.#table.write(row, place(nodes[index], copy));
      }
    }
    this.uniforms.setTexture(NODE_TABLE, this.#table.upload());
  }

  destroy(): void {
    this.#table.destroy();
  }
}
