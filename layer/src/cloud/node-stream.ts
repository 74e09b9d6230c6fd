import { isAbort } from "../errors/index.js";
import {
  type BoundsOf,
  LruCache,
  type NodeStore,
  type OctreeNode,
  type Selection,
  selectNodes,
  type TraversalOptions,
  type View,
} from "../octree/index.js";
import type { NodeVertices } from "../workers/index.js";

/** What the stream needs of a data set. */
export interface StreamSource {
  readonly store: NodeStore;
  readonly boundsOf: BoundsOf;
  /** Reads, decodes, places and packs a node's points. */
  loadVertices(node: OctreeNode, signal: AbortSignal): Promise<NodeVertices>;
  /** Reads the page that a node stands for and puts its entries into the store. */
  openPage(node: OctreeNode, signal: AbortSignal): Promise<void>;
}

/** Who wants to hear of the stream; each is called outside any frame, as answers arrive. */
export interface StreamListener {
  nodeLoaded?(node: OctreeNode): void;
  nodeFailed?(node: OctreeNode, error: Error): void;
  /** A node's vertices are given up: free whatever was made of them. */
  nodeEvicted?(node: OctreeNode): void;
}

/** How much the stream does at once and keeps. */
export interface StreamLimits {
  /** Nodes and pages being loaded at the same time. Default: 8, two more than browsers ask of one HTTP/1.1 server. */
  readonly requests?: number;
  /** Bytes of vertices that are kept. Default: 268,435,456. */
  readonly cacheBytes?: number;
}

/** How far what a view wants is here. */
export interface StreamProgress {
  /** Nodes wanted. */
  readonly wanted: number;
  /** Of these, ready. */
  readonly ready: number;
  /** Of these, failed; pages that cannot be read count as well. */
  readonly failed: number;
  /** Nodes and pages of the view that are still to come. */
  readonly pending: number;
}

/**
 * Brings the nodes that views want, most important first, and gives up those that none wanted for longest.
 * Several views may share one stream: a node that two of them want is loaded once.
 */
export class NodeStream {
  readonly #source: StreamSource;
  readonly #requests: number;
  readonly #cache: LruCache<OctreeNode, NodeVertices>;
  readonly #selections = new Map<object, Selection>();
  readonly #queued = new Set<OctreeNode>();
  readonly #active = new Map<OctreeNode, AbortController>();
  readonly #failed = new Set<OctreeNode>();
  readonly #listeners = new Set<StreamListener>();
  /** Nodes of all selections with their rank, 0 first. */
  #wanted = new Map<OctreeNode, number>();

  constructor(source: StreamSource, limits: StreamLimits = {}) {
    this.#source = source;
    this.#requests = limits.requests ?? 8;
    this.#cache = new LruCache({
      points: Number.POSITIVE_INFINITY,
      bytes: limits.cacheBytes ?? 268_435_456,
    });
  }

  /** Nodes and pages being loaded. */
  get active(): number {
    return this.#active.size;
  }

  /** Bytes of vertices held. */
  get bytes(): number {
    return this.#cache.bytes;
  }

  /** @returns removes the listener */
  subscribe(listener: StreamListener): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /** Vertices of a node that is ready; undefined otherwise. */
  vertices(node: OctreeNode): NodeVertices | undefined {
    return this.#cache.peek(node);
  }

  /**
   * Tells what a view shows now. Loading starts and stops accordingly.
   * @param viewer stands for the view; the same object in each call
   */
  update(viewer: object, view: View, options: TraversalOptions): Selection {
    const selection = selectNodes(this.#source.store.root, view, options, this.#source.boundsOf);
    this.#selections.set(viewer, selection);
    this.#rank();
    for (const node of selection.nodes) this.#cache.use(node);
    this.#cancelUnwanted();
    this.#queueWanted();
    this.#pump();
    this.#trim();
    return selection;
  }

  /** A view ends; what only it wanted is no longer loaded. */
  detach(viewer: object): void {
    this.#selections.delete(viewer);
    this.#rank();
    this.#cancelUnwanted();
  }

  progress(viewer: object): StreamProgress {
    const selection = this.#selections.get(viewer);
    let ready = 0;
    let failed = 0;
    for (const node of selection?.nodes ?? []) {
      if (node.state === "ready") ready++;
      if (node.state === "failed") failed++;
    }
    const failedPages = selection?.pages.filter((node) => node.state === "failed").length ?? 0;
    const wanted = selection?.nodes.length ?? 0;
    const pages = selection?.pages.length ?? 0;
    return {
      wanted,
      ready,
      failed: failed + failedPages,
      pending: wanted - ready - failed + pages - failedPages,
    };
  }

  /** Lets what failed be tried again, once a view wants it. */
  retryFailed(): void {
    for (const node of this.#failed) {
      if (node.state !== "failed") continue;
      node.become(node.pageFailed ? "page" : "listed");
      node.pageFailed = false;
    }
    this.#failed.clear();
  }

  /** Stops all loading and gives up everything. */
  destroy(): void {
    this.#selections.clear();
    this.#rank();
    this.#cancelUnwanted();
    this.#cache.limits = { points: 0, bytes: 0 };
    this.#trim();
    this.#listeners.clear();
  }

  #rank(): void {
    this.#wanted = new Map();
    for (const { nodes, pages } of this.#selections.values()) {
      // Pages come with the rank of the most important node: what lies behind them is not known yet.
      for (const page of pages) this.#wanted.set(page, 0);
      nodes.forEach((node, index) => {
        this.#wanted.set(node, Math.min(index, this.#wanted.get(node) ?? index));
      });
    }
  }

  #cancelUnwanted(): void {
    for (const [node, controller] of this.#active) if (!this.#wanted.has(node)) controller.abort();
    for (const node of this.#queued) {
      if (this.#wanted.has(node)) continue;
      this.#queued.delete(node);
      node.become("listed");
    }
  }

  #queueWanted(): void {
    for (const node of this.#wanted.keys()) {
      if (node.state !== "listed") continue;
      node.become("queued");
      this.#queued.add(node);
    }
  }

  #pump(): void {
    if (this.#active.size >= this.#requests) return;
    const candidates: OctreeNode[] = [];
    for (const node of this.#wanted.keys()) {
      if (node.state === "page" || node.state === "queued") candidates.push(node);
    }
    if (this.#selections.size > 1) {
      candidates.sort((a, b) => (this.#wanted.get(a) ?? 0) - (this.#wanted.get(b) ?? 0));
    }
    for (const node of candidates) {
      if (this.#active.size >= this.#requests) return;
      void (node.state === "page" ? this.#open(node) : this.#load(node));
    }
  }

  async #open(node: OctreeNode): Promise<void> {
    const controller = new AbortController();
    this.#active.set(node, controller);
    node.become("opening");
    try {
      await this.#source.openPage(node, controller.signal);
    } catch (thrown) {
      if (controller.signal.aborted || isAbort(thrown)) node.become("page");
      else {
        node.pageFailed = true;
        this.#fail(node, thrown);
      }
    }
    this.#settle(node);
  }

  async #load(node: OctreeNode): Promise<void> {
    const controller = new AbortController();
    this.#active.set(node, controller);
    this.#queued.delete(node);
    node.become("loading");
    try {
      const vertices = await this.#source.loadVertices(node, controller.signal);
      controller.signal.throwIfAborted();
      this.#cache.set(node, vertices, { points: vertices.count, bytes: vertices.vertices.byteLength });
      node.become("ready");
      for (const listener of this.#listeners) listener.nodeLoaded?.(node);
    } catch (thrown) {
      if (controller.signal.aborted || isAbort(thrown)) node.become("listed");
      else this.#fail(node, thrown);
    }
    this.#settle(node);
  }

  /** What an answer leaves free is used at once, without waiting for the next frame. */
  #settle(node: OctreeNode): void {
    this.#active.delete(node);
    this.#queueWanted();
    this.#pump();
  }

  #fail(node: OctreeNode, thrown: unknown): void {
    node.become("failed");
    this.#failed.add(node);
    const error = thrown instanceof Error ? thrown : new Error(String(thrown));
    for (const listener of this.#listeners) listener.nodeFailed?.(node, error);
  }

  #trim(): void {
    for (const [node] of this.#cache.trim((candidate) => this.#wanted.has(candidate))) {
      node.become("listed");
      for (const listener of this.#listeners) listener.nodeEvicted?.(node);
    }
  }
}
