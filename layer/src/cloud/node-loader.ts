import { LruCache, type OctreeNode } from "../octree/index.js";
import { noNode } from "../query/index.js";
import type { EncodedChunk, PointSource } from "../sources/contract/point-source.js";
import {
  type Appearance,
  type ChunkJob,
  checkNodeSize,
  type NodeExecutor,
  type NodeRecords,
  type NodeVertices,
} from "../workers/index.js";
import { showSixteenBits } from "./appearance.js";
import type { NodeGeometry } from "./node-geometry.js";
import { type SharedReads, unlessAborted } from "./shared-reads.js";

/** The node that decides for all how colours are read and what columns count from, loaded or not. */
type Judged =
  | { readonly node: OctreeNode; readonly vertices: NodeVertices }
  | { readonly node: OctreeNode; readonly error: unknown };

/** What is known of a node before it stands in the octree. */
type ListedNode = Pick<OctreeNode, "name" | "key" | "address" | "pointCount">;

/** What a loader works with. */
export interface LoaderParts {
  readonly source: Pick<PointSource, "name" | "bytesPerPoint" | "chunk">;
  readonly executor: NodeExecutor;
  /** Chunks by the names of their nodes, which other octrees of the data set read too. */
  readonly chunks: SharedReads<EncodedChunk>;
  /** Number of the data set with the executor. */
  readonly dataSet: number;
  readonly geometry: Pick<NodeGeometry, "cube">;
  readonly root: OctreeNode;
  /** Told of each node that was made. */
  readonly made?: (vertices: NodeVertices) => void;
  /** Told when nodes that were made before have to {@link showSixteenBits}. */
  readonly judgedAgain?: () => void;
  /** Undefined: judged by the first node. */
  readonly appearance: Appearance | undefined;
}

/** Bytes of records that are kept for points to be read again: some ten nodes. */
const RECORD_BYTES = 32 * 1024 * 1024;

/** Reads the chunks of nodes and has them made into vertices or records. */
export class NodeLoader {
  readonly #parts: LoaderParts;
  // By name, not by node: hierarchy pages may be given up meanwhile, and bring other nodes when they are read again.
  readonly #records = new LruCache<string, NodeRecords>({
    points: Number.POSITIVE_INFINITY,
    bytes: RECORD_BYTES,
  });
  readonly #reading = new Map<string, Promise<NodeRecords>>();
  #appearance: Appearance | undefined;
  #judging: Promise<Judged> | undefined;
  /** The node that was begun before it was asked for; undefined where it cannot be had ahead. */
  #begun: { readonly name: string; readonly vertices: Promise<NodeVertices | undefined> } | undefined;

  constructor(parts: LoaderParts) {
    this.#parts = parts;
    this.#appearance = parts.appearance;
  }

  /** How the points look, as recorded or as judged by the first node; undefined until that is here. */
  get appearance(): Appearance | undefined {
    return this.#appearance;
  }

  /**
   * Begins with a node that will be asked for, where its points need not decide how all look. What fails is told to whoever
   * asks, who may do so before the node is listed: it is made once.
   * @param listed the node; undefined where it is not known ahead
   */
  begin(name: string, listed: Promise<ListedNode | undefined>): void {
    if (!this.#appearance) return;
    const vertices = listed.then((node) => node && this.#make(node, undefined));
    vertices.catch(() => undefined);
    this.#begun = { name, vertices };
  }

  /** @throws SourceError, DecodeError, PlacementError */
  async vertices(node: OctreeNode, signal: AbortSignal): Promise<NodeVertices> {
    if (this.#begun?.name === node.name) {
      const { vertices } = this.#begun;
      this.#begun = undefined;
      const begun = await unlessAborted(vertices, signal);
      if (begun) return begun;
    }
    if (!this.#appearance) {
      this.#judging ??= this.#judge(firstNode(this.#parts.root) ?? node);
      const judged = await this.#judging;
      signal.throwIfAborted();
      if (judged.node === node) {
        this.#judging = undefined;
        if ("error" in judged) throw judged.error;
        return judged.vertices;
      }
    }
    return this.#make(node, signal);
  }

  /**
   * A node's points as recorded; a few nodes are kept. Whoever asks for a node that is being read waits with the
   * others, and may stop waiting.
   * @throws SourceError, DecodeError; the signal's reason when aborted
   */
  async records(node: OctreeNode, signal: AbortSignal): Promise<NodeRecords> {
    signal.throwIfAborted();
    const { name } = node;
    const kept = this.#records.use(name);
    if (kept) return kept;
    let reading = this.#reading.get(name);
    if (!reading) {
      reading = this.#decode(node).finally(() => this.#reading.delete(name));
      this.#reading.set(name, reading);
    }
    return unlessAborted(reading, signal);
  }

  async #decode(node: OctreeNode): Promise<NodeRecords> {
    const { name, pointCount } = node;
    const job = await this.#jobOf(node, undefined);
    const records = await this.#done(this.#parts.executor.records(job), name);
    this.#records.set(name, records, { points: pointCount, bytes: bytesOf(records) });
    this.#records.trim((candidate) => candidate === name);
    return records;
  }

  /**
   * Loads the node by which colours are judged. Not cancelled with whoever came first, since all others wait
   * for it; should it be damaged, the next one decides.
   */
  async #judge(node: OctreeNode): Promise<Judged> {
    try {
      return { node, vertices: await this.#make(node, undefined) };
    } catch (error) {
      return { node, error };
    }
  }

  async #make(node: ListedNode, signal: AbortSignal | undefined): Promise<NodeVertices> {
    const job = { ...(await this.#jobOf(node, signal)), appearance: this.#appearance };
    const vertices = await this.#done(this.#parts.executor.run(job, signal), node.name);
    this.#appearance ??= vertices.seen;
    const { rgbBits } = this.#appearance ?? vertices;
    if (rgbBits === 8 && vertices.rgbBits === 16) this.#judgeAgain();
    else if (rgbBits === 16) showSixteenBits(vertices);
    this.#parts.made?.(vertices);
    return vertices;
  }

  /** A node needs 16 bits: so do all, those that are here as well. */
  #judgeAgain(): void {
    if (this.#appearance) this.#appearance = { ...this.#appearance, rgbBits: 16 };
    this.#parts.judgedAgain?.();
  }

  /** A job's outcome. A chunk that cannot be decoded is read again when it is next asked for. */
  async #done<T>(job: Promise<T>, name: string): Promise<T> {
    try {
      return await job;
    } catch (thrown) {
      this.#parts.chunks.forget(name);
      throw thrown;
    }
  }

  async #jobOf(node: ListedNode, signal: AbortSignal | undefined): Promise<ChunkJob> {
    const { source, chunks, dataSet, geometry } = this.#parts;
    const { address, pointCount, name } = node;
    if (address === undefined || pointCount === 0) throw noNode(name, source.name);
    const { name: file, bytesPerPoint } = source;
    checkNodeSize({ file, node: name, pointCount, bytesPerPoint });
    const read = (until: AbortSignal) => source.chunk(address, { signal: until });
    const { bytes, checksum } = await chunks.read(name, signal, read);
    // Whoever decodes a chunk takes it away.
    return {
      dataSet,
      chunk: bytes.slice(0),
      checksum,
      pointCount,
      node: name,
      cube: geometry.cube(node.key),
    };
  }
}

/** Bytes that a node's records take. */
function bytesOf({ xyz, order, attributes }: NodeRecords): number {
  const buffers = new Set([xyz, order, ...attributes.map(({ bytes }) => bytes)].map(({ buffer }) => buffer));
  return [...buffers].reduce((sum, { byteLength }) => sum + byteLength, 0);
}

/** The known node nearest to the root that has points. */
function firstNode(root: OctreeNode): OctreeNode | undefined {
  const queue: OctreeNode[] = [root];
  for (let node = queue.shift(); node; node = queue.shift()) {
    if (node.pointCount > 0) return node;
    for (const child of node.children ?? []) if (child) queue.push(child);
  }
  return undefined;
}
