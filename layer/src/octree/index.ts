export { type CacheLimits, type Cost, LruCache } from "./lru-cache.js";
export { isLegal, type NodeState } from "./node-state.js";
export { NodeStore } from "./node-store.js";
export { type NodeBounds, OctreeNode } from "./octree-node.js";
export { PriorityQueue } from "./priority-queue.js";
export {
  type BoundsOf,
  priorityOf,
  type Selection,
  selectNodes,
  type TraversalOptions,
} from "./traversal.js";
export { behindHorizon, distanceTo, outsideFrustum, projectedSize, type View } from "./view.js";
export { isWithin, keyName, parseKey, ROOT_KEY, sameKey, type VoxelKey } from "./voxel-key.js";
