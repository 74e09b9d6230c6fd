import type { PageAddress } from "../sources/index.js";
import { assertLegal, type NodeState } from "./node-state.js";
import { keyName, octant, type VoxelKey } from "./voxel-key.js";

/** Where a node lies on the globe and how dense it is: all that a traversal needs of it. */
export interface NodeBounds {
  /** Centre of a sphere around the node's part of the data, ECEF, metres. */
  readonly x: number;
  readonly y: number;
  readonly z: number;
  /** Radius of that sphere, metres. */
  readonly radius: number;
  /** Distance between the node's points, metres on the ground. */
  readonly spacing: number;
}

/** One node of the octree: its place in the file and its state. What was loaded for it is kept elsewhere. */
export class OctreeNode {
  readonly key: VoxelKey;
  /** The children that the hierarchy lists, by octant; undefined until the first is known. */
  children: (OctreeNode | undefined)[] | undefined;
  /** Number of points; 0 until the page is read. */
  pointCount = 0;
  /** Chunk of points, or the page while the state is `page` or `opening`. */
  address: PageAddress | undefined;
  /** True where the failure was in reading the page rather than the points. */
  pageFailed = false;
  /** Set by whoever knows the coordinate system, when first asked for. */
  bounds: NodeBounds | undefined;
  /** The last round of whoever streams it in which a view wanted it, and its rank among all wanted, 0 first. */
  round = 0;
  rank = 0;
  #state: NodeState;

  constructor(key: VoxelKey, state: "page" | "empty" | "listed" = "empty") {
    this.key = key;
    this.#state = state;
  }

  get state(): NodeState {
    return this.#state;
  }

  /** `depth-x-y-z` */
  get name(): string {
    return keyName(this.key);
  }

  /**
   * Goes to another state.
   * @throws Error where the change is not legal
   */
  become(next: NodeState): void {
    assertLegal(this.#state, next, this.name);
    this.#state = next;
  }

  /** Child by its key, or undefined. */
  child(key: VoxelKey): OctreeNode | undefined {
    return this.children?.[octant(key)];
  }

  /** Puts a child in its octant. */
  adopt(child: OctreeNode): void {
    this.children ??= new Array<OctreeNode | undefined>(8).fill(undefined);
    this.children[octant(child.key)] = child;
  }
}
