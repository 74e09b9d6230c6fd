import { callListener, isAbort, SourceError } from "../errors/index.js";
import {
  type BoundsOf,
  LruCache,
  type NodeStore,
  type OctreeNode,
  type Selection,
  type SharedBudget,
  selectNodes,
  type TraversalOptions,
  type View,
} from "../octree/index.js";
import type { ServerWait } from "../sources/contract/point-source.js";
import type { NodeVertices } from "../workers/index.js";
import { Comeback } from "./comeback.js";
import { WantedNodes } from "./wanted-nodes.js";

/** What the stream needs of a data set. */
export interface StreamSource {
  readonly store: NodeStore;
  readonly boundsOf: BoundsOf;
  /** Reads, decodes, places and packs a node's points. */
  loadVertices(node: OctreeNode, signal: AbortSignal): Promise<NodeVertices>;
  /** Reads the page that a node stands for and puts its entries into the store. */
  openPage(node: OctreeNode, signal: AbortSignal): Promise<void>;
  /** Why its server is waited for, where it is. */
  readonly wait?: ServerWait | undefined;
}

/** Who wants to hear of the stream; each is called outside any frame, as answers arrive. What one throws is reported. */
export interface StreamListener {
  nodeLoaded?(node: OctreeNode): void;
  /** A node cannot be had; not called for what is asked for again by itself. */
  nodeFailed?(node: OctreeNode, error: Error): void;
  /** A node's vertices are given up: free whatever was made of them. */
  nodeEvicted?(node: OctreeNode): void;
}

/** How much the stream does at once and keeps. */
export interface StreamLimits {
  /**
   * Nodes being loaded at the same time, smaller ones than of 4,096 points by their part of that, pages as sixteenths; more
   * are started once half of them are here. Those that lie next to each other in the file go in one request. Default: 16.
   */
  readonly requests?: number;
  /** Bytes of vertices that are kept. Default: 268,435,456. */
  readonly cacheBytes?: number;
  /**
   * Nodes of the octree that are known at once, their points loaded or not, 230 to 270 bytes each. Beyond it, what
   * views have not come by for longest is forgotten, and read again when one does. Default: 500,000.
   */
  readonly knownNodes?: number;
  /** Budget whose bytes several clouds share; holds beside `cacheBytes`. */
  readonly budget?: SharedBudget;
}

/** How far what a view wants is here; told of a layer, how far it is drawn. */
export interface StreamProgress {
  /** Nodes wanted; those of which too little shows to be asked for count where they are here. */
  readonly wanted: number;
  /** Of these, ready. */
  readonly ready: number;
  /** Of these, failed; pages that cannot be read count as well. */
  readonly failed: number;
  /** Nodes and pages of the view that are still to come, those among them that a server cannot give for now. */
  readonly pending: number;
  /** Why the server gives nothing for now, and when it is asked again; undefined: it answers, or nothing is to come. */
  readonly waiting?: ServerWait | undefined;
}

/**
 * Brings the nodes that views want, most important first, and gives up those that none wanted for longest.
 * Several views may share one stream: a node that two of them want is loaded once.
 */
export class NodeStream {
  readonly #source: StreamSource;
  readonly #requests: number;
  readonly #budget: SharedBudget | undefined;
  readonly #cache: LruCache<OctreeNode, NodeVertices>;
  readonly #wanted = new WantedNodes({
    node: (node) => this.#cache.use(node),
    page: (page) => this.#source.store.use(page),
  });
  readonly #budgets = new Map<object, SharedBudget | undefined>();
  readonly #queued = new Set<OctreeNode>();
  readonly #active = new Map<OctreeNode, AbortController>();
  readonly #failed = new Set<OctreeNode>();
  readonly #comeback = new Comeback((node) => this.#askAgain(node));
  readonly #listeners = new Set<StreamListener>();
  /** Index of the first of the wanted nodes that may still wait for its turn. */
  #next = 0;
  #changes = 0;

  constructor(source: StreamSource, limits: StreamLimits = {}) {
    this.#source = source;
    this.#requests = limits.requests ?? 16;
    this.#budget = limits.budget;
    this.#cache = new LruCache({
      points: Number.POSITIVE_INFINITY,
      bytes: limits.cacheBytes ?? 268_435_456,
    });
    source.store.limit = limits.knownNodes ?? 500_000;
  }

  /** Nodes and pages being loaded. */
  get active(): number {
    return this.#active.size;
  }

  /** Rises with whatever may give a view other nodes than it has, although it stands still. */
  get changes(): number {
    return this.#changes;
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

  /** Calls back with the vertices of each node that is ready. */
  forEachVertices(work: (vertices: NodeVertices) => void): void {
    for (const vertices of this.#cache.values()) work(vertices);
  }

  /**
   * Tells what a view shows now. Loading starts and stops accordingly.
   * @param viewer stands for the view; the same object in each call
   */
  update(viewer: object, view: View, options: TraversalOptions): Selection {
    const selection = selectNodes(this.#source.store.root, view, options, this.#source.boundsOf, viewer);
    const before = this.#budgets.get(viewer);
    if (before !== options.budget) before?.release(viewer);
    this.#budgets.set(viewer, options.budget);
    this.#want(viewer, selection);
    for (const node of this.#wanted.list) this.#queue(node);
    this.#pump();
    this.trim();
    return selection;
  }

  /** Loads the root's points before any view tells what it shows, since all of them draw those. */
  loadRoot(): void {
    const { root } = this.#source.store;
    if (root.state !== "listed") return;
    root.become("queued");
    void this.#load(root);
  }

  /** A view ends; what only it wanted is no longer loaded. */
  detach(viewer: object): void {
    this.#budgets.get(viewer)?.release(viewer);
    this.#budgets.delete(viewer);
    this.#want(viewer, undefined);
    this.trim();
  }

  progress(viewer: object): StreamProgress {
    const selection = this.#wanted.selectionOf(viewer);
    let wanted = 0;
    let ready = 0;
    let failed = 0;
    for (const node of selection?.nodes ?? []) {
      const isReady = node.state === "ready";
      if (isReady || node.asked) wanted++;
      if (isReady) ready++;
      if (node.asked && this.#hasFailed(node)) failed++;
    }
    const failedPages = selection?.pages.filter((node) => this.#hasFailed(node)).length ?? 0;
    const pages = selection?.pages.length ?? 0;
    const pending = wanted - ready - failed + pages - failedPages;
    return {
      wanted,
      ready,
      failed: failed + failedPages,
      pending,
      waiting: pending > 0 ? this.#waiting : undefined,
    };
  }

  /** Lets what failed be tried again, once a view wants it, and what is waited for now. */
  retryFailed(): void {
    this.#changes++;
    for (const node of this.#failed) restore(node);
    this.#failed.clear();
    this.#comeback.hasten();
  }

  /** Gives up what is beyond the limits and no view wants; each update does. */
  trim(): void {
    this.#trimVertices();
    this.#trimPages();
  }

  /** Stops all loading and gives up everything. */
  destroy(): void {
    for (const viewer of this.#wanted.viewers) this.detach(viewer);
    this.#cancelUnwanted();
    this.#cache.limits = { points: 0, bytes: 0 };
    this.trim();
    this.#budget?.cpu.report(this, 0);
    this.#comeback.clear();
    this.#listeners.clear();
  }

  /** A view wants something else, or nothing any more: what only it wanted before is no longer loaded. */
  #want(viewer: object, selection: Selection | undefined): void {
    this.#wanted.set(viewer, selection);
    this.#next = 0;
    this.#cancelUnwanted();
  }

  #cancelUnwanted(): void {
    for (const [node, controller] of this.#active) {
      if (!this.#wanted.tolerates(node)) controller.abort();
    }
    for (const node of this.#queued) {
      if (this.#wanted.has(node) && node.asked) continue;
      this.#queued.delete(node);
      node.become("listed");
    }
  }

  #queue(node: OctreeNode): void {
    if (node.state !== "listed" || !node.asked) return;
    node.become("queued");
    this.#queued.add(node);
  }

  /** Starts what is next in rank, several at once, since what is asked for together may come in one request. */
  #pump(): void {
    let load = 0;
    for (const node of this.#active.keys()) load += loadOf(node);
    if (load > this.#requests / 2) return;
    const { list } = this.#wanted;
    for (; this.#next < list.length && load < this.#requests; this.#next++) {
      const node = list[this.#next];
      if (node.state !== "page" && node.state !== "queued") continue;
      load += loadOf(node);
      if (node.state === "page") void this.#openPage(node);
      else void this.#load(node);
    }
  }

  async #openPage(node: OctreeNode): Promise<void> {
    const controller = new AbortController();
    this.#active.set(node, controller);
    node.become("opening");
    try {
      await this.#source.openPage(node, controller.signal);
      this.#comeback.arrived(node);
    } catch (thrown) {
      if (controller.signal.aborted || isAbort(thrown)) {
        node.become("page");
        this.#comeback.forget(node);
      } else {
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
      this.#cache.set(node, vertices, { points: vertices.count, bytes: vertices.bytes });
      this.#budget?.cpu.report(this, this.#cache.bytes);
      node.become("ready");
      this.#comeback.arrived(node);
      this.#tell((listener) => listener.nodeLoaded?.(node));
    } catch (thrown) {
      if (controller.signal.aborted || isAbort(thrown)) {
        node.become("listed");
        this.#comeback.forget(node);
      } else this.#fail(node, thrown);
    }
    this.#settle(node);
  }

  /** What an answer leaves free is used at once, without waiting for the next frame. */
  #settle(node: OctreeNode): void {
    this.#changes++;
    this.#active.delete(node);
    if (this.#wanted.has(node) && (node.state === "listed" || node.state === "page")) {
      // Stopped, and wanted again since: its turn was passed over.
      this.#queue(node);
      this.#next = 0;
    }
    this.#pump();
  }

  #fail(node: OctreeNode, thrown: unknown): void {
    node.become("failed");
    const error = thrown instanceof Error ? thrown : new Error(String(thrown));
    const passing = error instanceof SourceError && error.outage !== undefined;
    if (passing && this.#comeback.add(node, error, this.#source.wait?.until)) return;
    this.#failed.add(node);
    this.#tell((listener) => listener.nodeFailed?.(node, error));
  }

  #tell(call: (listener: StreamListener) => void): void {
    for (const listener of this.#listeners) callListener(() => call(listener));
  }

  /** Whether a node failed for good, as far as nobody asks for it again. */
  #hasFailed(node: OctreeNode): boolean {
    return node.state === "failed" && !this.#comeback.has(node);
  }

  get #waiting(): ServerWait | undefined {
    const { wait } = this.#source;
    return this.#active.size > 0 ? (wait ?? this.#comeback.wait) : (this.#comeback.wait ?? wait);
  }

  /** Asks again for a node that could not be had for now. @returns whether a view wants it */
  #askAgain(node: OctreeNode): boolean {
    this.#changes++;
    if (!restore(node) || !this.#wanted.has(node)) return false;
    this.#queue(node);
    this.#next = 0;
    this.#pump();
    return true;
  }

  #trimVertices(): void {
    const inUse = (node: OctreeNode) => this.#wanted.has(node);
    const evicted = this.#cache.trim(inUse, this.#budget?.cpu.excess ?? 0);
    if (evicted.length > 0) this.#changes++;
    for (const [node] of evicted) {
      node.become("listed");
      this.#tell((listener) => listener.nodeEvicted?.(node));
    }
    if (evicted.length > 0) this.#budget?.cpu.report(this, this.#cache.bytes);
  }

  #trimPages(): void {
    const { store } = this.#source;
    if (!store.trim((page) => this.#wanted.restsOn(page))) return;
    for (const node of this.#failed) if (node.page?.dropped) this.#failed.delete(node);
  }
}

/** Puts a node that failed back to where it was. @returns false where it did not fail or has left the octree */
function restore(node: OctreeNode): boolean {
  if (node.state !== "failed" || node.page?.dropped) return false;
  node.become(node.pageFailed ? "page" : "listed");
  node.pageFailed = false;
  return true;
}

/** Points of a node that counts as one of those loaded at the same time. */
const LARGE = 4096;

/** Part of such a node that a page and the smallest node count as. */
const SMALLEST = 1 / 16;

/** What a node counts among those that are loaded at the same time: small ones go together, whatever their number. */
function loadOf({ pointCount }: OctreeNode): number {
  return Math.min(1, Math.max(SMALLEST, pointCount / LARGE));
}
