import type { HierarchyEntry } from "../sources/contract/point-source.js";
import type { NodeStore } from "./node-store.js";
import type { OctreeNode } from "./octree-node.js";

/** Puts entries into the octree as the page of a node that is `opening`. */
export function insertPage(store: NodeStore, node: OctreeNode, entries: readonly HierarchyEntry[]): void {
  const draft = store.draft(node);
  for (const entry of entries) draft.take(entry);
  draft.grow();
  store.insertPage(draft);
}
