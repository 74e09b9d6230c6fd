import { FormatError } from "../errors/index.js";
import {
  keyName,
  type NodeStore,
  type OctreeNode,
  parseKey,
  sameKey,
  type VoxelKey,
} from "../octree/index.js";
import type { PointSource } from "../sources/contract/point-source.js";
import { openPage } from "./open-page.js";

/** What nodes are found in. */
export interface NodeAccessParts {
  readonly source: Pick<PointSource, "name" | "page">;
  readonly store: NodeStore;
  /** Told each time that work with a node has ended, so that pages may be given up. */
  readonly released: () => void;
}

/** Finds nodes of an octree by their keys: reads hierarchy pages on the way, and keeps a node while it is worked with. */
export class NodeAccess {
  readonly #parts: NodeAccessParts;
  readonly #opening = new Map<OctreeNode, Promise<void>>();
  #closed = false;

  constructor(parts: NodeAccessParts) {
    this.#parts = parts;
  }

  /**
   * Reads the first page of the hierarchy.
   * @throws FormatError FORMAT_HIERARCHY where it names no node with points
   * @throws SourceError; the signal's reason when aborted
   */
  async openRoot(signal?: AbortSignal): Promise<void> {
    const { source, store } = this.#parts;
    const { root } = store;
    root.become("opening");
    await this.openPage(root, signal);
    if (root.pointCount > 0 || root.children) return;
    throw new FormatError({
      code: "FORMAT_HIERARCHY",
      file: source.name,
      cause: "its octree names no node with points",
      fix: "Convert the scan again",
    });
  }

  /** Finds none any more: whoever asks hears that the data set was closed. */
  close(): void {
    this.#closed = true;
  }

  /** Reads the page that a node in the state `opening` stands for. @throws as {@link openPage} */
  async openPage(node: OctreeNode, signal?: AbortSignal): Promise<void> {
    const { source, store } = this.#parts;
    const reading = openPage(source, store, node, signal);
    this.#opening.set(node, reading);
    try {
      await reading;
    } finally {
      this.#opening.delete(node);
    }
  }

  /**
   * Works with the node with points that a key names, which stays in the octree meanwhile.
   * @throws FormatError FORMAT_NODE where the octree has no such node; an AbortError when it is closed
   */
  async withPoints<T>(
    key: VoxelKey | string,
    signal: AbortSignal,
    work: (node: OctreeNode) => Promise<T>,
  ): Promise<T> {
    const file = this.#parts.source.name;
    const wanted = typeof key === "string" ? parseKey(key) : key;
    if (!wanted) throw noNode(String(key), file);
    return this.withNode(wanted, signal, (node) => {
      if (node.pointCount === 0) throw noNode(node.name, file);
      return work(node);
    });
  }

  /** The same with a node that need not have points. @throws as {@link withPoints} */
  async withNode<T>(
    key: VoxelKey,
    signal: AbortSignal,
    work: (node: OctreeNode) => T | Promise<T>,
  ): Promise<T> {
    const { source, store } = this.#parts;
    for (;;) {
      signal.throwIfAborted();
      if (this.#closed) throw new DOMException(`the data set ${source.name} is closed`, "AbortError");
      const node = store.closest(key);
      const opening = this.#opening.get(node);
      if (opening) await opening.catch(() => undefined);
      else if (node.state === "page" || node.pageFailed) await this.#openAgain(node, signal);
      else if (!sameKey(node.key, key)) throw noNode(keyName(key), source.name);
      else return this.#holding(node, work);
    }
  }

  /** Keeps a node in the octree, and its page from being the next to go, while work is done with it. */
  async #holding<T>(node: OctreeNode, work: (node: OctreeNode) => T | Promise<T>): Promise<T> {
    const { page } = node;
    page?.hold();
    try {
      return await work(node);
    } finally {
      page?.release();
      if (page) this.#parts.store.use(page);
      this.#parts.released();
    }
  }

  async #openAgain(node: OctreeNode, signal: AbortSignal): Promise<void> {
    if (node.pageFailed) node.become("page");
    node.pageFailed = false;
    node.become("opening");
    try {
      await this.openPage(node, signal);
    } catch (thrown) {
      node.become("page");
      throw thrown;
    }
  }
}

/** The error for a node that is not there. */
export function noNode(name: string, file: string): FormatError {
  return new FormatError({
    code: "FORMAT_NODE",
    file,
    cause: `its octree has no node ${name} with points`,
    fix: "Ask for a node that the octree lists",
  });
}
