import type { HierarchyPage, OctreeNode, Selection } from "../octree/index.js";

/** Hears of what some view wanted and none wants any more: it counts as used until now. */
interface Former {
  node(node: OctreeNode): void;
  page(page: HierarchyPage): void;
}

/**
 * What the views of one stream want, taken together: nodes and pages by their rank, and what they rest on. Each call that
 * changes it begins a round, whose number nodes and pages bear, so that asking whether one is wanted takes no look-up.
 */
export class WantedNodes {
  readonly #former: Former;
  readonly #selections = new Map<object, Selection>();
  #list: OctreeNode[] = [];
  /** Pages of the hierarchy that views go through. */
  #open: HierarchyPage[] = [];
  #fringe = new Set<OctreeNode>();
  #round = 1;

  constructor(former: Former) {
    this.#former = former;
  }

  /** Nodes and pages that views want, first in rank first, whether they are here or not. */
  get list(): readonly OctreeNode[] {
    return this.#list;
  }

  /** The views that want something. */
  get viewers(): readonly object[] {
    return [...this.#selections.keys()];
  }

  /** What a view wants, as it told last. */
  selectionOf(viewer: object): Selection | undefined {
    return this.#selections.get(viewer);
  }

  /** A view wants something else; undefined: it has ended. */
  set(viewer: object, selection: Selection | undefined): void {
    if (selection) this.#selections.set(viewer, selection);
    else this.#selections.delete(viewer);
    this.#rank();
  }

  has(node: OctreeNode): boolean {
    return node.round === this.#round;
  }

  /** Whether a node, or its page, may go on where it is on its way: it is wanted, or too small by little. */
  tolerates(node: OctreeNode): boolean {
    return this.has(node) || this.#fringe.has(node);
  }

  /** Whether a view goes through a page, or wants it. */
  restsOn(page: HierarchyPage): boolean {
    return page.round === this.#round || this.tolerates(page.root);
  }

  #rank(): void {
    const before = this.#list;
    const openBefore = this.#open;
    this.#list = [];
    this.#open = [];
    this.#fringe = new Set();
    this.#round++;
    for (const { nodes, worth, pages, open, fringe } of this.#selections.values()) {
      // Pages come with the rank of the most important node: what lies behind them is not known yet.
      for (const page of pages) this.#want(page, 0, true);
      for (let index = 0; index < nodes.length; index++) this.#want(nodes[index], index, worth[index]);
      for (const node of fringe) this.#fringe.add(node);
      for (const page of open) {
        if (page.round !== this.#round) this.#open.push(page);
        page.round = this.#round;
      }
    }
    if (this.#selections.size > 1) this.#list.sort((a, b) => a.rank - b.rank);
    for (const node of before) if (!this.has(node)) this.#former.node(node);
    for (const page of openBefore) if (page.round !== this.#round) this.#former.page(page);
  }

  #want(node: OctreeNode, rank: number, asked: boolean): void {
    if (this.has(node)) {
      node.rank = Math.min(node.rank, rank);
      node.asked ||= asked;
      return;
    }
    node.round = this.#round;
    node.rank = rank;
    node.asked = asked;
    this.#list.push(node);
  }
}
