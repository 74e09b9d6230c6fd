import type { HierarchyEntry } from "../sources/index.js";
import type { NodeStore } from "./node-store.js";
import type { OctreeNode } from "./octree-node.js";

/** Puts entries into the octree as the page of a node that is `opening`. */
export function insertPage(store: NodeStore, node: OctreeNode, entries: readonly HierarchyEntry[]): void {
  const draft = store.draft(node);
  draft.take(entries);
  draft.grow();
  store.insertPage(draft);
}
