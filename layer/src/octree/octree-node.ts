import { assertLegal, isHeld, type NodeState } from "./node-state.js";
import { keyName, octant, type VoxelKey } from "./voxel-key.js";

/** Where a node lies on the globe, or on a map, and how dense it is: all that a traversal needs of it. */
export interface NodeBounds {
  /**
   * Centre of a sphere around the node's part of the data, ECEF, metres; on a map the plane of its projection, in
   * nominal metres, and the height above WGS 84.
   */
  readonly x: number;
  readonly y: number;
  readonly z: number;
  /** Radius of that sphere, metres. */
  readonly radius: number;
  /** Distance between the node's points, metres on the ground. */
  readonly spacing: number;
  /** The same on the globe, of a node that lies on a map. */
  readonly onGlobe?: NodeBounds;
}

/** One node of the octree: its place in the file and its state. What was loaded for it is kept elsewhere. */
export class OctreeNode {
  readonly key: VoxelKey;
  /** The children that the hierarchy lists, by octant; undefined until the first is known. */
  children: (OctreeNode | undefined)[] | undefined;
  /** Number of points; 0 until the page is read. */
  pointCount = 0;
  /**
   * Where the source finds its points, or its page while the state is `page` or `opening`: handed back to the source,
   * opaque to everyone else. Undefined where there is neither.
   */
  address: unknown;
  /** The page that lists it; while the state is `page` or `opening` the one that refers to its page. */
  page: HierarchyPage | undefined;
  /** True where the failure was in reading the page rather than the points. */
  pageFailed = false;
  /** Set by whoever knows the coordinate system, when first asked for. */
  bounds: NodeBounds | undefined;
  /** The last round of whoever streams it in which a view wanted it, and its rank among all wanted, 0 first. */
  round = 0;
  rank = 0;
  /** Whether a view of that round wants so much of it that it is to be asked for. */
  asked = false;
  /**
   * Its index in the list of nodes that somebody goes through just now, who sets it beforehand: a list has the node where it
   * has it at this index, whoever set that.
   */
  index = 0;
  /** Where the numbers of its points stand in the {@link NodeShapes} of its octree, which sets it; −1 where they are not here. */
  slot = -1;
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
   * @throws Error where the change is not legal, or the node has left the octree
   */
  become(next: NodeState): void {
    const state = this.#state;
    assertLegal(state, next, this);
    const { page } = this;
    if (page?.dropped) throw new Error(`node ${this.name} has left the octree`);
    this.#state = next;
    if (isHeld(next) && !isHeld(state)) page?.hold();
    else if (isHeld(state) && !isHeld(next)) page?.release();
  }

  /** Child by its key, or undefined. */
  child(key: VoxelKey): OctreeNode | undefined {
    return this.children?.[octant(key)];
  }

  /** The deepest known node above a key within this node, or at it, down to a depth. */
  closest(key: VoxelKey, depth: number): OctreeNode {
    let node: OctreeNode = this;
    for (let at = this.key.depth + 1; at <= depth; at++) {
      const next = node.children?.[octant(key, at)];
      if (!next) break;
      node = next;
    }
    return node;
  }

  /** Puts a child in its octant. */
  adopt(child: OctreeNode): void {
    this.children ??= new Array<OctreeNode | undefined>(8).fill(undefined);
    this.children[octant(child.key)] = child;
  }
}

/** One page of the hierarchy as it was read: what it brought into the octree, and whether that is in use. */
export class HierarchyPage {
  /** The node that stands for it in the page above. */
  readonly root: OctreeNode;
  readonly address: unknown;
  /** The page that refers to it; undefined for the first of the file. */
  readonly above: HierarchyPage | undefined;
  /** Pages that it refers to, as far as they were read. */
  readonly below = new Set<HierarchyPage>();
  /** Nodes that it brought; its root was known before. */
  nodes = 0;
  /** Points of its nodes, the root's included. */
  points = 0;
  /** The last round of whoever streams it in which a view went through it. */
  round = 0;
  /** True once its nodes have left the octree. */
  dropped = false;
  #holds = 0;

  constructor(root: OctreeNode, address: unknown) {
    this.root = root;
    this.address = address;
    this.above = root.page;
  }

  /** Whether it must stay: a node of it, or of a page below, is waiting, on its way or here, or is being read. */
  get held(): boolean {
    return this.#holds > 0;
  }

  /** Keeps it, and the pages above, until as many calls of {@link release}. */
  hold(): void {
    for (let page: HierarchyPage | undefined = this; page; page = page.above) page.#holds++;
  }

  release(): void {
    for (let page: HierarchyPage | undefined = this; page; page = page.above) page.#holds--;
  }
}
