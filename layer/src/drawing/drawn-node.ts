import type { NodeClips } from "../clips/index.js";
import type { EffectPlan } from "../effects/index.js";
import type { OctreeNode } from "../octree/index.js";
import type { GpuTypes } from "./gpu.js";
import type { UploadedNode } from "./node-uploads.js";

/** The types of what a view draws with. */
export interface ViewTypes extends GpuTypes {
  /** A node that is uploaded, with what the view needs to draw it. */
  readonly node: UploadedNode;
}

/** A node as a frame shows it. */
export interface DrawnNode<V extends ViewTypes = ViewTypes> {
  readonly node: OctreeNode;
  readonly uploaded: V["node"];
  /** Points that are drawn, from the first in drawing order. */
  readonly count: number;
  /** Number of its first point among all points drawn. */
  readonly firstId: number;
  readonly uniforms: V["uniforms"];
  /** What volumes make of it. */
  readonly clips: NodeClips;
  /** The effects that it is drawn with: those of the layer, or the same without volumes where none crosses it. */
  readonly plan: EffectPlan;
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
