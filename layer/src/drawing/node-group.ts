import { type EffectPlan, NODE_NUMBER, NODE_TABLE, nodeLayoutOf, nodeUniforms } from "../effects/index.js";
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
  #rows = 0;
  /** What the values of nodes follow from besides themselves. */
  #styled: StyledBy | undefined;
  /** What effects say of nodes, as rows of the table by their slots, and of which node each of these rows is. */
  #values = new Float32Array(0);
  readonly #valued: (V["node"] | undefined)[] = [];
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
    return this.#rows;
  }

  /** Those of the last frame that are still there, by rising row; the same array until they, or their places, are others. */
  get nodes(): readonly DrawnNode<V>[] {
    return this.#nodes;
  }

  /**
   * Takes the nodes of a frame; the row of each is its index.
   * @param plan one with the same key
   */
  take(plan: EffectPlan, nodes: readonly DrawnNode<V>[]): void {
    this.#plan = plan;
    this.#nodes = nodes;
    this.#rows = nodes.length;
    const {
      style,
      facts: { filter, attributes },
    } = plan.scene;
    const by = this.#styled;
    if (by?.style === style && by.filter === filter && by.attributes === attributes) return;
    this.#styled = { style, filter, attributes };
    this.#valued.length = 0;
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
   * @param place writes what the view says of a copy of a node, its matrices, into a row of the table
   */
  place(
    copies: number,
    by: readonly unknown[],
    place: (node: DrawnNode<V>, copy: number, table: Float32Array, begin: number) => void,
  ): void {
    const ground = [this.#nodes, copies, ...by];
    if (sameGround(ground, this.#placed)) return;
    this.#placed = ground;
    const table = this.#table;
    table.reserve(copies * this.#rows);
    const { data } = table;
    for (let copy = 0; copy < copies; copy++) {
      for (let index = 0; index < this.#nodes.length; index++) {
        const node = this.#nodes[index];
        const row = copy * this.#rows + node.row;
        const { uploaded } = node;
        if (this.#valued[uploaded.slot] !== uploaded) this.#form(node);
        table.write(row, this.#values, uploaded.slot, node);
        place(node, copy, data, table.beginOf(row));
      }
    }
    this.uniforms.setTexture(NODE_TABLE, table.upload());
  }

  /** Where a value that the view writes begins in a row; undefined where programs read none of that name. */
  placeIn(name: string): number | undefined {
    return this.#table.placeIn(name);
  }

  destroy(): void {
    this.#table.destroy();
  }

  /** Forms what effects say of a node, once for a style. */
  #form({ node, uploaded }: DrawnNode<V>): void {
    const { slot } = uploaded;
    const { columns, toCube, step } = uploaded.vertices;
    const values = nodeUniforms(this.#plan, {
      ...{ columns, toCube, step },
      level: node.key.depth,
      spacing: node.bounds?.spacing ?? 0,
    });
    const table = this.#table;
    if (table.beginOf(slot + 1) > this.#values.length) {
      const before = this.#values;
      this.#values = new Float32Array(2 * table.beginOf(slot + 1));
      this.#values.set(before);
    }
    table.writeValues(this.#values, slot, values, step);
    this.#valued[slot] = uploaded;
  }
}

/** What of a scene the values of nodes follow from. */
type StyledBy = Pick<EffectPlan["scene"], "style"> &
  Pick<EffectPlan["scene"]["facts"], "filter" | "attributes">;
