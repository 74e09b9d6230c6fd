import { NodeShapes, type ShapedPoints } from "./node-shapes.js";
import type { OctreeNode } from "./octree-node.js";

/** What is here of some nodes. @param points at the same indices; undefined where they are not here */
export function nodesHere(nodes: readonly OctreeNode[], points: readonly (ShapedPoints | undefined)[]) {
  const shapes = new NodeShapes();
  for (const [index, node] of nodes.entries()) {
    const own = points[index];
    node.slot = -1;
    if (own) shapes.add(node, own);
  }
  return { slots: Int32Array.from(nodes, (node) => shapes.slotOf(node)), shapes };
}
