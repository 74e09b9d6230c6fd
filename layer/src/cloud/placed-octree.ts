import type { MapPlane } from "@groma/georef";
import {
  keyName,
  type NodeBounds,
  NodeShapes,
  NodeStore,
  type OctreeNode,
  type VoxelKey,
} from "../octree/index.js";
import { NodeAccess } from "../query/index.js";
import type {
  EncodedChunk,
  HierarchyEntry,
  PointSource,
  SourceBox,
} from "../sources/contract/point-source.js";
import {
  type Appearance,
  checkNodeSize,
  type DataSetSpec,
  type NodeExecutor,
  type NodeVertices,
} from "../workers/index.js";
import { showSixteenBits } from "./appearance.js";
import type { NodeGeometry } from "./node-geometry.js";
import { NodeLoader } from "./node-loader.js";
import { NodeStream, type StreamLimits } from "./node-stream.js";
import { Replay, SharedReads } from "./shared-reads.js";

/** Bytes of encoded points that are kept for other octrees of the data set, and to be decoded again. */
const CHUNK_BYTES = 64 * 1024 * 1024;
/** Pages of the hierarchy that are kept where a map has an octree of its own, the first one not counted. */
export const SHARED_PAGES = 64;

/** What all octrees of a data set have in common, wherever its points are placed. */
export interface OctreeParts {
  readonly source: PointSource;
  readonly executor: NodeExecutor;
  readonly limits: StreamLimits;
  readonly chunks: SharedReads<EncodedChunk>;
  /** Pages by their addresses: the first of the file, and the others. */
  readonly firstPage: SharedReads<Iterable<HierarchyEntry>>;
  readonly pages: SharedReads<Iterable<HierarchyEntry>>;
}

/** What several octrees of one data set read together. */
export function sharedReads(): Pick<OctreeParts, "chunks" | "firstPage" | "pages"> {
  return {
    chunks: new SharedReads<EncodedChunk>(CHUNK_BYTES, ({ bytes }) => bytes.byteLength),
    firstPage: new SharedReads<Iterable<HierarchyEntry>>(1, () => 1),
    // As long as there is one octree only, what it forgets is to be forgotten.
    pages: new SharedReads<Iterable<HierarchyEntry>>(0, () => 1),
  };
}

/**
 * Asks for the points of the root, which every view draws, as soon as the first page is there: they are on their way while
 * the data set is still being placed. What fails is asked for again by whoever needs it, who then hears of it.
 * @returns what the first page says of the root; undefined where it has no points, or they could not be had
 */
export async function readRootAhead(
  parts: Pick<OctreeParts, "source" | "chunks" | "firstPage" | "pages">,
  signal: AbortSignal,
): Promise<HierarchyEntry | undefined> {
  const { source, chunks } = parts;
  try {
    for (const root of await readPage(parts, source.rootPage, { signal })) {
      const { depth, pointCount, address } = root;
      if (depth > 0 || pointCount <= 0) continue;
      const node = keyName(root);
      checkNodeSize({ file: source.name, node, pointCount, bytesPerPoint: source.bytesPerPoint });
      await chunks.read(node, signal, (until) => source.chunk(address, { signal: until }));
      return root;
    }
  } catch {
    // Told where it is read again.
  }
  return undefined;
}

/** Where an octree's points are placed, and by what. */
export interface Placing {
  readonly geometry: NodeGeometry;
  readonly spec: DataSetSpec;
  readonly appearance: Appearance | undefined;
  /** Told of each node that was made. */
  readonly made: (vertices: NodeVertices) => void;
  /** Sphere of a node on the globe, where the octree lies elsewhere. */
  readonly onGlobe?: ((key: VoxelKey) => NodeBounds) | undefined;
}

/** The octree of a data set as its points are placed: on the globe, or in the plane of a map. */
export class PlacedOctree {
  readonly store: NodeStore;
  readonly geometry: NodeGeometry;
  readonly loader: NodeLoader;
  /** Finds nodes by their keys. */
  readonly access: NodeAccess;
  /** Brings nodes for views. */
  readonly stream: NodeStream;
  /** What frames ask of the points that are here. */
  readonly shapes = new NodeShapes<NodeVertices>();
  /** The plane of a map that it lies in; undefined: it lies on the globe. */
  readonly plane: MapPlane | undefined;
  readonly #parts: OctreeParts;
  readonly #dataSet: number;
  #bounds: NodeBounds | undefined;

  constructor(parts: OctreeParts, placing: Placing) {
    const { source, executor, chunks, limits } = parts;
    const { geometry, spec, onGlobe } = placing;
    this.#parts = parts;
    this.plane = spec.plane;
    this.store = new NodeStore(source.name, source.pointCount, source.rootPage);
    this.access = new NodeAccess({
      source: { name: source.name, page: (address, options) => readPage(parts, address, options) },
      store: this.store,
      released: () => this.stream.trim(),
    });
    this.geometry = geometry;
    this.#bounds = this.#boundsOf(this.store.root.key, onGlobe);
    this.#dataSet = executor.addDataSet(spec);
    this.loader = new NodeLoader({
      ...{ source, executor, chunks, dataSet: this.#dataSet, geometry },
      ...{ root: this.store.root, appearance: placing.appearance, made: placing.made },
      judgedAgain: () => this.stream.forEachVertices(showSixteenBits),
    });
    this.stream = new NodeStream(
      {
        store: this.store,
        boundsOf: ({ key }) => this.#boundsOf(key, onGlobe) ?? this.#bounds!,
        loadVertices: (node, signal) => this.loader.vertices(node, signal),
        openPage: (node, signal) => this.access.openPage(node, signal),
        get wait() {
          return source.wait;
        },
      },
      limits,
    );
    // First of all listeners, so that the others find the node as it is by then.
    this.stream.subscribe({
      nodeLoaded: (node) => this.shapes.add(node, this.stream.vertices(node)!),
      nodeEvicted: (node) => this.shapes.remove(node),
    });
  }

  /** Sphere around all points; undefined where they have no place. */
  get bounds(): NodeBounds | undefined {
    return this.#bounds;
  }

  /** Has the root decoded before it stands in the octree. @param read what {@link readRootAhead} will come to */
  beginRoot(read: Promise<HierarchyEntry | undefined>): void {
    const { name, key } = this.store.root;
    const listed = read.then((root) => root && { name, key, ...root });
    this.loader.begin(name, listed);
  }

  /** Goes by another box of all points from now on. */
  widen(boundingBox: SourceBox): void {
    this.geometry.widen(boundingBox);
    this.#bounds = this.geometry.bounds(this.store.root.key) ?? this.#bounds;
    forgetBounds(this.store.root);
  }

  /** Stops all loading. */
  destroy(): void {
    this.stream.destroy();
    this.access.close();
    this.#parts.executor.removeDataSet(this.#dataSet);
  }

  #boundsOf(key: VoxelKey, onGlobe: Placing["onGlobe"]): NodeBounds | undefined {
    const bounds = this.geometry.bounds(key);
    return bounds && onGlobe ? { ...bounds, onGlobe: onGlobe(key) } : bounds;
  }
}

/** Reads a page, unless it was read before. What turns out to be damaged is read again when it is next asked for. */
function readPage(
  { source, firstPage, pages }: Pick<OctreeParts, "source" | "firstPage" | "pages">,
  address: unknown,
  { signal }: { readonly signal?: AbortSignal | undefined } = {},
): Promise<Iterable<HierarchyEntry>> {
  const reads = address === source.rootPage ? firstPage : pages;
  return reads.read(address, signal, async (until) => {
    const entries = await source.page(address, { signal: until });
    return new Replay(entries, () => reads.forget(address));
  });
}

/** Has the spheres of a node and of all below it reckoned anew. */
function forgetBounds(node: OctreeNode): void {
  node.bounds = undefined;
  for (const child of node.children ?? []) if (child) forgetBounds(child);
}
