import { badHierarchy, type HierarchyEntry } from "../sources/index.js";
import { OctreeNode } from "./octree-node.js";
import { ancestorAt, isWithin, keyName, octant, ROOT_KEY, sameKey, type VoxelKey } from "./voxel-key.js";

/**
 * The octree as far as its hierarchy pages were read. Pages are held against each other: a page that is
 * read twice, names a node outside its own, or one that is already known, is an error.
 */
export class NodeStore {
  readonly root: OctreeNode;
  readonly #file: string;
  readonly #pointLimit: number;
  readonly #pages = new Set<number>();
  #points = 0;
  #size = 1;

  /**
   * @param file name for errors
   * @param pointLimit number of points in the whole file; all nodes together cannot hold more
   */
  constructor(file: string, pointLimit: number, rootPage: { offset: number; length: number }) {
    this.#file = file;
    this.#pointLimit = pointLimit;
    this.root = new OctreeNode(ROOT_KEY, "page");
    this.root.address = rootPage;
  }

  /** Number of nodes known. */
  get size(): number {
    return this.#size;
  }

  /** Number of points in the nodes known. */
  get points(): number {
    return this.#points;
  }

  /**
   * Takes in the entries of the page that `node` stands for; the node must be `opening` and afterwards is
   * `listed` or `empty`.
   * @throws FormatError FORMAT_HIERARCHY
   */
  insertPage(node: OctreeNode, entries: readonly HierarchyEntry[]): void {
    const { address } = node;
    if (!address) throw new Error(`node ${node.name} has no page`);
    if (this.#pages.has(address.offset))
      throw badHierarchy(this.#file, `the page at byte ${address.offset} twice`);
    const points = this.#points;
    const size = this.#size;
    try {
      this.#insert(node, entries);
    } catch (thrown) {
      // Nothing of a damaged page stays.
      node.children = undefined;
      node.pointCount = 0;
      node.address = address;
      this.#points = points;
      this.#size = size;
      throw thrown;
    }
    this.#pages.add(address.offset);
    node.become(node.pointCount > 0 ? "listed" : "empty");
  }

  #insert(node: OctreeNode, entries: readonly HierarchyEntry[]): void {
    node.address = undefined;
    // Parents first, whatever the order in the file.
    const sorted = [...entries].sort((a, b) => a.depth - b.depth);
    let own = 0;
    for (const entry of sorted) {
      if (!isWithin(entry, node.key)) {
        throw badHierarchy(this.#file, `node ${keyName(entry)} in the page of node ${node.name}`);
      }
      if (!sameKey(entry, node.key)) this.#add(node, entry);
      else if (entry.pointCount === -1 || own++ > 0)
        throw badHierarchy(this.#file, `node ${node.name} twice`);
      else this.#count(node, entry);
    }
  }

  /** The node with the key given as far as it is known, else its closest known ancestor. */
  closest(key: VoxelKey): OctreeNode {
    return closestBelow(this.root, key, key.depth);
  }

  #add(page: OctreeNode, entry: HierarchyEntry): void {
    const parent = this.#parentOf(page, entry);
    if (parent.child(entry)) throw badHierarchy(this.#file, `node ${keyName(entry)} twice`);
    const { depth, x, y, z } = entry;
    const state = entry.pointCount === -1 ? "page" : entry.pointCount > 0 ? "listed" : "empty";
    const node = new OctreeNode({ depth, x, y, z }, state);
    if (state === "page") node.address = entry.address;
    else this.#count(node, entry);
    parent.adopt(node);
    this.#size++;
  }

  /** Parent of an entry. Some writers leave out nodes without points: those are put in as empty. */
  #parentOf(page: OctreeNode, entry: HierarchyEntry): OctreeNode {
    let node = closestBelow(page, entry, entry.depth - 1);
    if (node.state === "page") {
      throw badHierarchy(this.#file, `node ${keyName(entry)} outside the page that it belongs to`);
    }
    while (node.key.depth < entry.depth - 1) {
      const between = new OctreeNode(ancestorAt(entry, node.key.depth + 1));
      node.adopt(between);
      this.#size++;
      node = between;
    }
    return node;
  }

  #count(node: OctreeNode, entry: HierarchyEntry): void {
    this.#points += entry.pointCount;
    if (this.#points > this.#pointLimit) {
      throw badHierarchy(this.#file, `more points than the ${this.#pointLimit} of the header`);
    }
    node.pointCount = entry.pointCount;
    if (entry.pointCount > 0) node.address = entry.address;
  }
}

/** The deepest known node above a key, or at it, from a node above it down to a depth. */
function closestBelow(from: OctreeNode, key: VoxelKey, depth: number): OctreeNode {
  let node = from;
  for (let at = from.key.depth + 1; at <= depth; at++) {
    const next = node.children?.[octant(key, at)];
    if (!next) break;
    node = next;
  }
  return node;
}
