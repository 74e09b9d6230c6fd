import { keyName, NodeStore } from "../octree/index.js";
import type { LasEnvelope, PointSource } from "../sources/contract/point-source.js";
import { type OpenedSource, type OpenOptions, openSource, type SourceLike } from "../sources/open-source.js";
import {
  checkNodeSize,
  decodeNode,
  decodersWith,
  LazDecoder,
  type RecordedNode,
  type StorageSpec,
} from "../workers/index.js";
import { NodeAccess } from "./node-access.js";
import { nodeCube, pointBox } from "./node-cube.js";
import { PointQuery, type QueryOptions, type QueryParts } from "./point-query.js";

/** How recorded points are opened. */
export interface RecordedPointsOptions extends OpenOptions {
  /** Gives the bytes of `groma-laz.wasm`, which decodes: a page fetches them, Node reads `@groma/layer/laz.wasm`. */
  readonly loadLaz: () => Promise<BufferSource>;
}

/** The points of a part of a data set. */
export type RecordQuery = Pick<PointQuery, "bracket" | "batches">;

/**
 * Whatever recorded points can be taken from: their integers, what these mean, and what a LAS file of them says besides.
 * A `PointCloud` is one, and so are {@link RecordedPoints}.
 */
export interface PointOrigin {
  /** What errors call it. */
  readonly name: string;
  /** Source units per step of the recorded integers, per axis: source coordinate = integer · scale + offset. */
  readonly scale: readonly [number, number, number];
  /** Source units, per axis. */
  readonly offset: readonly [number, number, number];
  /** The recorded points of a part of it. @throws RangeError where the spacing is not a number from 0 on */
  query(options?: QueryOptions): RecordQuery;
  /**
   * What a LAS file of some of the points begins and ends with; undefined where they are no LAS records.
   * @throws SourceError, FormatError; the signal's reason when aborted
   */
  lasEnvelope(options?: { readonly signal?: AbortSignal | undefined }): Promise<LasEnvelope | undefined>;
}

/** Hierarchy nodes beyond which pages are given up: some hundred megabytes. */
const MOST_NODES = 500_000;

/**
 * A data set for whoever works with its points and does not draw them: no place on the globe, and so no coordinate
 * system, is needed. Nodes are decoded on the calling thread.
 */
export class RecordedPoints implements PointOrigin {
  /** What the data set says of itself. */
  readonly source: OpenedSource;
  readonly #access: NodeAccess;
  readonly #spec: StorageSpec;
  readonly #decoders: ReturnType<typeof decodersWith>;

  private constructor(source: OpenedSource, loadLaz: RecordedPointsOptions["loadLaz"]) {
    const { name, encoding, bytesPerPoint, scale, offset } = source;
    const store = new NodeStore(name, source.pointCount, source.rootPage);
    store.limit = MOST_NODES;
    this.source = source;
    this.#access = new NodeAccess({ source, store, released: () => store.trim(() => false) });
    this.#spec = { file: name, encoding, bytesPerPoint, scale, offset };
    this.#decoders = decodersWith(new LazDecoder(loadLaz));
  }

  /**
   * Opens a data set: what it says of itself and the first page of its hierarchy; no points yet.
   * @throws SourceError, FormatError; the signal's reason when aborted
   */
  static async open(from: SourceLike, options: RecordedPointsOptions): Promise<RecordedPoints> {
    const points = new RecordedPoints(await openSource(from, options), options.loadLaz);
    await points.#access.openRoot(options.signal);
    return points;
  }

  get name(): string {
    return this.source.name;
  }

  get scale(): PointSource["scale"] {
    return this.source.scale;
  }

  get offset(): PointSource["offset"] {
    return this.source.offset;
  }

  async lasEnvelope(
    options: { readonly signal?: AbortSignal | undefined } = {},
  ): Promise<LasEnvelope | undefined> {
    return this.source.lasEnvelope?.(options);
  }

  /** As {@link PointOrigin.query}; the spacing is in source units, since how large they are is not known. */
  query(options: QueryOptions = {}): PointQuery {
    const { source } = this;
    const parts: QueryParts = {
      withNode: (key, signal, work) => this.#access.withNode(key, signal, work),
      records: ({ key, address, pointCount }, signal) => this.#records(key, address, pointCount, signal),
      box: (key, out) => pointBox(source, key, out),
      file: source.name,
      spacing: source.spacing,
      scale: source.scale,
      offset: source.offset,
    };
    return new PointQuery(parts, options);
  }

  async #records(
    key: Parameters<typeof keyName>[0],
    address: unknown,
    pointCount: number,
    signal: AbortSignal,
  ): Promise<RecordedNode> {
    const { name, bytesPerPoint, cube } = this.source;
    const node = keyName(key);
    checkNodeSize({ file: name, node, pointCount, bytesPerPoint });
    const { bytes, checksum } = await this.source.chunk(address, { signal });
    const job = { chunk: bytes, checksum, pointCount, node, cube: nodeCube(cube, key) };
    return decodeNode(this.#spec, job, this.#decoders);
  }
}
