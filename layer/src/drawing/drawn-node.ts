import type { NodeClips } from "../clips/index.js";
import type { EffectPlan } from "../effects/index.js";
import type { OctreeNode } from "../octree/index.js";
import type { GpuTypes } from "./gpu.js";
import type { UploadedNode } from "./node-uploads.js";
import type { AttributeSet } from "./vertex-attributes.js";

/** The types of what a view draws with. */
export interface ViewTypes extends GpuTypes {
  /** A node that is uploaded, with what the view needs to draw it. */
  readonly node: UploadedNode & {
    /** The vertex array that programs with these attributes read. */
    arrayOf(reads: AttributeSet): ViewTypes["vertexArray"];
  };
}

/** What nodes are drawn with together. */
export interface DrawnWith<V extends ViewTypes = ViewTypes> {
  readonly plan: EffectPlan;
  /** The table of the nodes among them. */
  readonly uniforms: V["uniforms"];
  /** Number of the nodes in the table; their copies follow, as many in each. */
  readonly rows: number;
}

/** A node as a frame shows it. */
export interface DrawnNode<V extends ViewTypes = ViewTypes> {
  readonly node: OctreeNode;
  readonly uploaded: V["node"];
  /** Points that are drawn, from the first in drawing order. */
  readonly count: number;
  /** Number of its first point among all points drawn. */
  readonly firstId: number;
  /** What volumes make of it. */
  readonly clips: NodeClips;
  /** Those that it is drawn with: by the effects of the layer, or the same without volumes where none crosses it. */
  readonly group: DrawnWith<V>;
  /** Its index among them, by which those of one page follow each other. */
  readonly row: number;
  /** Its texel in the texture of the visible octree; 0 where no effect reads that. */
  readonly octreeIndex: number;
  /** First texel and number of its records in the texture of clips. */
  readonly clipRecords: readonly [first: number, count: number];
}

/** The node and the index in its drawing order that a number among all points drawn stands for, counted from 0. */
export function pointOf<Node extends Pick<DrawnNode, "firstId" | "count">>(
  nodes: readonly Node[],
  id: number,
): { readonly drawn: Node; readonly index: number } | undefined {
  let low = 0;
  let high = nodes.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (nodes[middle].firstId <= id) low = middle + 1;
    else high = middle;
  }
  const drawn = nodes[low - 1];
  const index = drawn ? id - drawn.firstId : 0;
  return drawn && index < drawn.count ? { drawn, index } : undefined;
}

/** Bytes of vertices that a point of these nodes takes on the GPU, the mean of all; 0 where there are none. */
export function bytesPerPoint(nodes: readonly Pick<DrawnNode, "uploaded">[]): number {
  let [bytes, points] = [0, 0];
  for (const { uploaded } of nodes) {
    bytes += uploaded.bytes;
    points += uploaded.count;
  }
  return points > 0 ? bytes / points : 0;
}

/** Nodes by what they are drawn in, each group's by rising row. */
export type GroupedNodes<V extends ViewTypes> = Iterable<readonly [DrawnWith<V>, readonly DrawnNode<V>[]]>;

/** Some nodes by what they are drawn in; `LayerContent.grouped` has all. */
export function byGroup<V extends ViewTypes>(nodes: Iterable<DrawnNode<V>>): GroupedNodes<V> {
  const groups = new Map<DrawnWith<V>, DrawnNode<V>[]>();
  for (const node of nodes) {
    const there = groups.get(node.group);
    if (there) there.push(node);
    else groups.set(node.group, [node]);
  }
  for (const members of groups.values()) members.sort((a, b) => a.row - b.row);
  return groups;
}
