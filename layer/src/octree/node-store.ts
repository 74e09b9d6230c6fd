import { badHierarchy } from "../sources/contract/point-source.js";
import { type HierarchyPage, OctreeNode } from "./octree-node.js";
import { PageDraft } from "./page-draft.js";
import { ROOT_KEY, type VoxelKey } from "./voxel-key.js";

/** Pages that one trim looks at, at most, so that no frame is held up. */
const LOOKS = 64;

/**
 * The octree as far as its hierarchy pages are known. Pages are held against each other: a page that names a node
 * outside its own, or one that is already known, is an error, so that none can come twice. Beyond a limit the pages used longest ago
 * are given up; their nodes leave the octree, and come anew when the page is read again.
 */
export class NodeStore {
  readonly root: OctreeNode;
  /** Nodes beyond which pages are given up. */
  limit = Number.POSITIVE_INFINITY;
  readonly #file: string;
  readonly #pointLimit: number;
  /** Pages that were read, the one used longest ago first. */
  readonly #pages = new Set<HierarchyPage>();
  #points = 0;
  #size = 1;

  /**
   * @param file name for errors
   * @param pointLimit number of points in the whole file; all nodes together cannot hold more
   * @param rootPage where the source finds the first page
   */
  constructor(file: string, pointLimit: number, rootPage: unknown) {
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

  /** Begins to put together the page that a node stands for. */
  draft(node: OctreeNode): PageDraft {
    return new PageDraft(this.#file, node);
  }

  /**
   * Puts a whole page into the octree; its root must be `opening` and afterwards is `listed` or `empty`.
   * @throws FormatError FORMAT_HIERARCHY; nothing of the page is in the octree then
   */
  insertPage({ page, root }: PageDraft): void {
    const { root: node, above } = page;
    if (this.#points + page.points > this.#pointLimit)
      throw badHierarchy(this.#file, `more points than the ${this.#pointLimit} of the header`);
    node.children = root.children;
    node.pointCount = root.pointCount;
    node.address = root.address;
    node.become(node.pointCount > 0 ? "listed" : "empty");
    node.page = page;
    above?.below.add(page);
    this.#pages.add(page);
    this.#points += page.points;
    this.#size += page.nodes;
  }

  /** The node with the key given as far as it is known, else its closest known ancestor. */
  closest(key: VoxelKey): OctreeNode {
    return this.root.closest(key, key.depth);
  }

  /** Notes that a page was used until now. */
  use(page: HierarchyPage): void {
    if (page.dropped) return;
    this.#pages.delete(page);
    this.#pages.add(page);
  }

  /**
   * Where there are more nodes than the limit, gives up pages, the one used longest ago first, with all below them.
   * Those that are held or in use count as used now, and the first of the file always stays.
   * @returns whether any went
   */
  trim(inUse: (page: HierarchyPage) => boolean): boolean {
    let looks = 0;
    let dropped = false;
    for (const page of this.#pages) {
      if (this.#size <= this.limit || looks++ === LOOKS) break;
      if (!page.above || page.held || inUse(page)) this.use(page);
      else {
        this.#drop(page);
        dropped = true;
      }
    }
    return dropped;
  }

  /** Puts the root of a page back to where it was before that was read. */
  #drop(page: HierarchyPage): void {
    const { root, address, above } = page;
    root.become("page");
    root.children = undefined;
    root.pointCount = 0;
    root.address = address;
    root.page = above;
    above?.below.delete(page);
    this.#forget(page);
  }

  #forget(page: HierarchyPage): void {
    for (const below of page.below) this.#forget(below);
    page.dropped = true;
    this.#pages.delete(page);
    this.#points -= page.points;
    this.#size -= page.nodes;
  }
}
