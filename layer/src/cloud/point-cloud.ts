import {
  type Crs,
  type HeightReference,
  type OperationReport,
  PlacementError,
  placePoint,
  type StatedAccuracy,
  type Truth,
} from "@groma/georef";
import { FormatError } from "../errors/index.js";
import {
  keyName,
  type NodeBounds,
  NodeStore,
  type OctreeNode,
  parseKey,
  sameKey,
  type VoxelKey,
} from "../octree/index.js";
import {
  type CloudStatistics,
  type CopcFile,
  type HttpOptions,
  openCopc,
  openSource,
  readHierarchyPage,
  type SourceLike,
} from "../sources/index.js";
import { type NodeExecutor, type NodeVertices, type PoolOptions, WorkerPool } from "../workers/index.js";
import { type Appearance, recordedAppearance, seenAppearance } from "./appearance.js";
import { type Georeference, type GeoreferenceOptions, georeferenceOf } from "./georeference.js";
import { NodeGeometry } from "./node-geometry.js";
import { NodeStream, type StreamLimits } from "./node-stream.js";

/** How a data set is opened. */
export interface PointCloudOptions extends GeoreferenceOptions, HttpOptions {
  /** Stops the opening. */
  readonly signal?: AbortSignal | undefined;
  /** Where nodes are decoded. Default: an own pool of workers. */
  readonly executor?: NodeExecutor | undefined;
  /** Options of that pool. */
  readonly workers?: PoolOptions | undefined;
  /** How much is loaded at once and kept. */
  readonly limits?: StreamLimits | undefined;
}

/** Least and greatest corner in source coordinates. */
export interface SourceBox {
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

/** The node that decides for all how colours are read, loaded or not. */
type Judged =
  | { readonly node: OctreeNode; readonly vertices: NodeVertices }
  | { readonly node: OctreeNode; readonly error: unknown };

/** A data set, opened once, whatever number of views draw it. Knows no view and no library of views. */
export class PointCloud {
  /** File name without the path. */
  readonly name: string;
  readonly pointCount: number;
  readonly crs: Crs;
  /** What the heights are measured from. */
  readonly height: HeightReference;
  /** What a drawn position is worth: named parts and their sum, metres. */
  readonly accuracy: StatedAccuracy;
  /** Who named the coordinate system. */
  readonly basis: Georeference["basis"];
  /** What the places come from. */
  readonly engine: Georeference["engine"];
  /** What that engine said of the way it chose; undefined where the page derives the places itself. */
  readonly operation: OperationReport | undefined;
  /** Files of the geoids that heights go through; empty where they are drawn as they are. */
  readonly geoids: readonly string[];
  /** The converter's statistics; undefined for files of other writers. */
  readonly statistics: CloudStatistics | undefined;
  /** As the header declares it, source units. */
  readonly boundingBox: SourceBox;
  /** Sphere around all points, ECEF, metres; `spacing` is that of the root. */
  readonly bounds: NodeBounds;
  /** Whether the points have colours of their own. */
  readonly hasColour: boolean;
  /** Brings nodes for views. */
  readonly stream: NodeStream;

  readonly #copc: CopcFile;
  readonly #truth: Truth;
  readonly #store: NodeStore;
  readonly #geometry: NodeGeometry;
  readonly #executor: NodeExecutor;
  readonly #ownsExecutor: boolean;
  readonly #dataSet: number;
  #appearance: Appearance | undefined;
  #judging: Promise<Judged> | undefined;
  readonly #opening = new Map<OctreeNode, Promise<void>>();

  private constructor(copc: CopcFile, georeference: Georeference, options: PointCloudOptions) {
    const { header, info, source } = copc;
    const { crs, sources, truth, tolerance } = georeference;
    this.#copc = copc;
    this.#truth = truth;
    this.name = baseName(source.name);
    this.pointCount = header.pointCount;
    this.crs = crs;
    this.height = crs.height;
    this.accuracy = georeference.accuracy;
    this.basis = georeference.basis;
    this.engine = georeference.engine;
    this.operation = georeference.operation;
    this.geoids = georeference.geoids;
    this.statistics = copc.statistics;
    this.boundingBox = { min: header.min, max: header.max };
    this.hasColour = header.pointFormat !== 6 && copc.statistics?.rgbBits !== null;
    this.#store = new NodeStore(source.name, header.pointCount, info.rootPage);
    this.#geometry = new NodeGeometry(info, header, truth, crs);
    this.bounds = this.#rootBounds();
    this.#appearance = recordedAppearance(copc);
    this.#ownsExecutor = options.executor === undefined;
    this.#executor = options.executor ?? new WorkerPool(options.workers);
    this.#dataSet = this.#executor.addDataSet({
      ...sources,
      file: source.name,
      pointFormat: header.pointFormat,
      recordLength: header.recordLength,
      scale: header.scale,
      offset: header.offset,
      heights: [header.min[2], header.max[2]],
      tolerance,
    });
    this.stream = new NodeStream(
      {
        store: this.#store,
        boundsOf: (node) => this.#geometry.bounds(node.key) ?? this.bounds,
        loadVertices: (node, signal) => this.#loadVertices(node, signal),
        openPage: (node, signal) => this.#openPage(node, signal),
      },
      options.limits,
    );
  }

  /**
   * Opens a COPC file: its header, coordinate system and the root page of its hierarchy; no points yet.
   * @param from an address, a `File` or `Blob`, or an own source of bytes
   * @throws SourceError, FormatError, CrsError, PlacementError, RecordError
   */
  static async fromUrl(from: SourceLike, options: PointCloudOptions = {}): Promise<PointCloud> {
    const source = await openSource(from, options);
    const copc = await openCopc(source, { signal: options.signal });
    const cloud = new PointCloud(copc, await georeferenceOf(copc, options), options);
    try {
      await cloud.#openRoot(options.signal);
    } catch (thrown) {
      cloud.destroy();
      throw thrown;
    }
    return cloud;
  }

  /** Least and greatest intensity: from the statistics, else from the first node that was loaded. */
  get intensityRange(): readonly [number, number] {
    return this.#appearance?.intensity ?? [0, 65535];
  }

  /**
   * Where a point is: source coordinates to ECEF by the map that the points are drawn by, exact, not fitted.
   * @param out receives X, Y, Z, metres
   * @throws PlacementError PLACE_DOMAIN where the data set's map has no such place
   */
  place(x: number, y: number, z: number, out: Float64Array = new Float64Array(3)): Float64Array {
    placePoint(this.#truth, x, y, z, out, this.#copc.source.name);
    return out;
  }

  /** Nodes of the octree that are known so far. */
  get nodeCount(): number {
    return this.#store.size;
  }

  /**
   * Loads one node, reading hierarchy pages on the way.
   * @param key the node, or its name `depth-x-y-z`
   * @throws FormatError FORMAT_NODE where the octree has no such node, or one without points
   * @throws SourceError, DecodeError, PlacementError
   */
  async loadNode(key: VoxelKey | string, options: { signal?: AbortSignal } = {}): Promise<NodeVertices> {
    const signal = options.signal ?? new AbortController().signal;
    const wanted = typeof key === "string" ? parseKey(key) : key;
    if (!wanted) throw this.#noNode(String(key));
    const node = await this.#reach(wanted, signal);
    if (!sameKey(node.key, wanted) || node.pointCount === 0) throw this.#noNode(keyName(wanted));
    return this.#loadVertices(node, signal);
  }

  /** The node with a key, or its closest ancestor that the octree has; reads the pages on the way. */
  async #reach(wanted: VoxelKey, signal: AbortSignal): Promise<OctreeNode> {
    for (;;) {
      const node = this.#store.closest(wanted);
      const opening = this.#opening.get(node);
      if (opening) await opening.catch(() => undefined);
      else if (node.state === "page" || node.pageFailed) await this.#openAgain(node, signal);
      else return node;
    }
  }

  async #openAgain(node: OctreeNode, signal: AbortSignal): Promise<void> {
    if (node.pageFailed) node.become("page");
    node.pageFailed = false;
    node.become("opening");
    try {
      await this.#openPage(node, signal);
    } catch (thrown) {
      node.become("page");
      throw thrown;
    }
  }

  /** Stops all loading and ends the workers. */
  destroy(): void {
    this.stream.destroy();
    this.#executor.removeDataSet(this.#dataSet);
    if (this.#ownsExecutor) this.#executor.destroy();
  }

  #rootBounds(): NodeBounds {
    const bounds = this.#geometry.bounds(this.#store.root.key);
    if (bounds) return bounds;
    const derived = typeof this.#truth === "function";
    const what = derived ? this.crs.name : "the transformation in its georeference record";
    throw new PlacementError({
      code: "PLACE_DOMAIN",
      file: this.#copc.source.name,
      cause: `its coordinates lie outside what ${what} covers`,
      fix: derived
        ? "Check the coordinate system, or give the right one with the option crs"
        : "Convert the scan again, or give its coordinate system with the option crs",
    });
  }

  async #openRoot(signal?: AbortSignal): Promise<void> {
    const { root } = this.#store;
    root.become("opening");
    await this.#openPage(root, signal);
    if (root.pointCount > 0 || root.children) return;
    throw new FormatError({
      code: "FORMAT_HIERARCHY",
      file: this.#copc.source.name,
      cause: "its octree names no node with points",
      fix: "Convert the scan again",
    });
  }

  async #openPage(node: OctreeNode, signal?: AbortSignal): Promise<void> {
    const { address } = node;
    if (!address) throw new Error(`node ${node.name} has no page`);
    const reading = readHierarchyPage(this.#copc, address, { signal }).then((entries) =>
      this.#store.insertPage(node, entries),
    );
    this.#opening.set(node, reading);
    try {
      await reading;
    } finally {
      this.#opening.delete(node);
    }
  }

  async #loadVertices(node: OctreeNode, signal: AbortSignal): Promise<NodeVertices> {
    if (!this.#appearance) {
      this.#judging ??= this.#judge(this.#firstNode() ?? node);
      const judged = await this.#judging;
      signal.throwIfAborted();
      if (judged.node === node) {
        this.#judging = undefined;
        if ("error" in judged) throw judged.error;
        return judged.vertices;
      }
    }
    return this.#run(node, signal);
  }

  /**
   * Loads the node by which colours are judged. Not cancelled with whoever came first, since all others wait
   * for it; should it be damaged, the next one decides.
   */
  async #judge(node: OctreeNode): Promise<Judged> {
    try {
      return { node, vertices: await this.#run(node, undefined) };
    } catch (error) {
      return { node, error };
    }
  }

  /** The known node nearest to the root that has points. */
  #firstNode(): OctreeNode | undefined {
    const queue: OctreeNode[] = [this.#store.root];
    for (let node = queue.shift(); node; node = queue.shift()) {
      if (node.pointCount > 0) return node;
      for (const child of node.children ?? []) if (child) queue.push(child);
    }
    return undefined;
  }

  async #run(node: OctreeNode, signal: AbortSignal | undefined): Promise<NodeVertices> {
    const { address, pointCount } = node;
    if (!address) throw this.#noNode(node.name);
    const { source } = this.#copc;
    const bytes = await source.read(address.offset, address.offset + address.length, { signal });
    const chunk =
      bytes.byteLength === bytes.buffer.byteLength ? (bytes.buffer as ArrayBuffer) : bytes.slice().buffer;
    const cube = this.#geometry.cube(node.key);
    const rgbBits = this.#appearance?.rgbBits;
    const job = { dataSet: this.#dataSet, chunk, pointCount, node: node.name, cube, rgbBits };
    const vertices = await this.#executor.run(job, signal);
    this.#appearance ??= seenAppearance(vertices);
    return vertices;
  }

  #noNode(name: string): FormatError {
    return new FormatError({
      code: "FORMAT_NODE",
      file: this.#copc.source.name,
      cause: `its octree has no node ${name} with points`,
      fix: "Ask for a node that the octree lists",
    });
  }
}

/** Last part of an address or path, decoded, without query. */
function baseName(name: string): string {
  const path = name.replace(/[?#].*$/, "");
  const last = path.slice(path.lastIndexOf("/") + 1) || path;
  try {
    return decodeURIComponent(last);
  } catch {
    return last;
  }
}
