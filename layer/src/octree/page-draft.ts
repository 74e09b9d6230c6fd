import { badHierarchy, type HierarchyEntry } from "../sources/contract/point-source.js";
import { HierarchyPage, OctreeNode } from "./octree-node.js";
import { ancestorAt, isWithin, keyName, sameKey } from "./voxel-key.js";

/** Entries by depth. */
type Levels = (HierarchyEntry[] | undefined)[];

/**
 * The nodes of one page while they are put together, a part at a time and aside from the octree, so that nobody ever
 * sees half a page. Given up simply by letting go of it.
 */
export class PageDraft {
  readonly page: HierarchyPage;
  /** Stands in for the page's root until all of the page is there. */
  readonly root: OctreeNode;
  readonly #file: string;
  readonly #levels: Levels = [];
  #named = false;
  /** Depth, and index there, of the next entry that becomes a node. */
  #depth = 0;
  #next = 0;

  /**
   * @param file name for errors
   * @param node the node that the page stands for
   */
  constructor(file: string, node: OctreeNode) {
    const { address } = node;
    if (address === undefined) throw new Error(`node ${node.name} has no page`);
    this.#file = file;
    this.page = new HierarchyPage(node, address);
    this.root = new OctreeNode(node.key);
  }

  /**
   * Takes in an entry of the page; they may come in whatever order.
   * @throws FormatError FORMAT_HIERARCHY where it belongs elsewhere
   */
  take(entry: HierarchyEntry): void {
    if (!isWithin(entry, this.root.key)) {
      throw badHierarchy(this.#file, `node ${keyName(entry)} in the page of node ${this.root.name}`);
    }
    this.#levels[entry.depth] ??= [];
    this.#levels[entry.depth]?.push(entry);
  }

  /**
   * Makes nodes of entries, parents first; all must have been taken in.
   * @param most entries
   * @returns whether there are more
   * @throws FormatError FORMAT_HIERARCHY
   */
  grow(most = Number.POSITIVE_INFINITY): boolean {
    for (let left = most; this.#depth < this.#levels.length; this.#depth++, this.#next = 0) {
      const level = this.#levels[this.#depth] ?? [];
      for (; this.#next < level.length; this.#next++, left--) {
        if (left <= 0) return true;
        this.#add(level[this.#next]);
      }
    }
    return false;
  }

  #add(entry: HierarchyEntry): void {
    if (sameKey(entry, this.root.key)) {
      if (entry.pointCount === -1 || this.#named) throw this.#twice(entry);
      this.#named = true;
      this.#fill(this.root, entry);
      return;
    }
    const parent = this.#parentOf(entry);
    if (parent.child(entry)) throw this.#twice(entry);
    const { depth, x, y, z, pointCount } = entry;
    const state = pointCount === -1 ? "page" : pointCount > 0 ? "listed" : "empty";
    const node = new OctreeNode({ depth, x, y, z }, state);
    if (state === "page") node.address = entry.address;
    else this.#fill(node, entry);
    this.#adopt(parent, node);
  }

  /** Parent of an entry. Some writers leave out nodes without points: those are put in as empty. */
  #parentOf(entry: HierarchyEntry): OctreeNode {
    let node = this.root.closest(entry, entry.depth - 1);
    if (node.state === "page") {
      throw badHierarchy(this.#file, `node ${keyName(entry)} outside the page that it belongs to`);
    }
    while (node.key.depth < entry.depth - 1) {
      const between = new OctreeNode(ancestorAt(entry, node.key.depth + 1));
      this.#adopt(node, between);
      node = between;
    }
    return node;
  }

  #adopt(parent: OctreeNode, node: OctreeNode): void {
    node.page = this.page;
    parent.adopt(node);
    this.page.nodes++;
  }

  #fill(node: OctreeNode, { pointCount, address }: HierarchyEntry): void {
    this.page.points += pointCount;
    node.pointCount = pointCount;
    if (pointCount > 0) node.address = address;
  }

  #twice(entry: HierarchyEntry): Error {
    return badHierarchy(this.#file, `node ${keyName(entry)} twice`);
  }
}
