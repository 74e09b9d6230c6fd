import type { NodeClips } from "../clips/index.js";
import type { EffectPlan } from "../effects/index.js";
import type { OctreeNode } from "../octree/index.js";
import type { NodeDrawable } from "./node-drawable.js";
import type { UniformValues } from "./uniform-values.js";

/** A node as a frame shows it. */
export interface DrawnNode {
  readonly node: OctreeNode;
  readonly drawable: NodeDrawable;
  /** Points that are drawn, from the first in drawing order. */
  readonly count: number;
  /** Number of its first point among all points drawn. */
  readonly firstId: number;
  readonly uniforms: UniformValues;
  /** What volumes make of it. */
  readonly clips: NodeClips;
  /** The effects that it is drawn with: those of the layer, or the same without volumes where none crosses it. */
  readonly plan: EffectPlan;
}

/** The node and the index in its drawing order that a number among all points drawn stands for, counted from 0. */
export function pointOf(
  nodes: readonly DrawnNode[],
  id: number,
): { readonly drawn: DrawnNode; readonly index: number } | undefined {
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
