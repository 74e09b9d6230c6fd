import {
  type Crs,
  type GeoreferenceRecord,
  geodeticToEcef,
  type HeightReference,
  type OperationReport,
  placePoint,
  type StatedAccuracy,
  sourceTransform,
  type Truth,
} from "@groma/georef";
import type { NodeBounds, VoxelKey } from "../octree/index.js";
import { checkSignal, type Kind, SHARED, shared } from "../options/index.js";
import {
  type PointOrigin,
  PointQuery,
  pointBox,
  type QueryOptions,
  type QueryParts,
} from "../query/index.js";
import { nextTurn } from "../query/pace.js";
import type { LasEnvelope, PointSource, SourceBox, SourceWarning } from "../sources/contract/point-source.js";
import type { CloudStatistics } from "../sources/contract/statistics.js";
import { type OpenedSource, openSource, type SourceLike } from "../sources/open-source.js";
import {
  type Appearance,
  type DataSetSpec,
  type NodeExecutor,
  type NodeVertices,
  WorkerPool,
} from "../workers/index.js";
import { recordedAppearance } from "./appearance.js";
import type { AttributeInfo, PointRecord } from "./attribute-info.js";
import { attributesOf } from "./attributes.js";
import { checkCloudOptions, type PointCloudOptions } from "./cloud-options.js";
import { georeferenceOf } from "./georeference.js";
import type { Georeference } from "./georeference-options.js";
import { MapOctrees } from "./map-octrees.js";
import type { PlaneOfMap } from "./map-truth.js";
import { NodeGeometry, rootBounds } from "./node-geometry.js";
import type { NodeStream } from "./node-stream.js";
import { type OctreeParts, PlacedOctree, readRootAhead, sharedReads } from "./placed-octree.js";
import { pointRecord, recordIndex } from "./point-record.js";
import { SourceExtent } from "./source-extent.js";

/** Name of the class, and version of what is internal here (see {@link SHARED}). */
const MARK = "PointCloud 1";

/** A data set as the sources and layers of all views take it. */
export const POINT_CLOUD: Kind<PointCloud> = shared(MARK);

/** What a data set is made of. */
interface Opened {
  readonly source: OpenedSource;
  readonly georeference: Georeference;
  readonly executor: NodeExecutor;
  readonly shared: ReturnType<typeof sharedReads>;
  /** Ends what was asked for ahead of any view. */
  readonly ahead: AbortController;
}

/** A data set, opened once, whatever number of views draw it. Knows no view and no library of views. */
export class PointCloud implements PointOrigin {
  /** @internal */
  readonly [SHARED] = MARK;
  /** File name without the path. */
  readonly name: string;
  readonly pointCount: number;
  /** What tells its points from those of other data sets, whatever their files are called; kept with what is measured. */
  readonly identity: string;
  readonly crs: Crs;
  /** What the heights are measured from. */
  readonly height: HeightReference;
  /** Who named the coordinate system. */
  readonly basis: "given" | "record" | "file";
  /** What the places come from. */
  readonly engine: GeoreferenceRecord["engine"];
  /** What that engine said of the way it chose; undefined where the page derives the places itself. */
  readonly operation: OperationReport | undefined;
  /** Files of the geoids that heights go through; empty where they are drawn as they are. */
  readonly geoids: readonly string[];
  /** The converter's statistics; undefined for files of other writers. */
  readonly statistics: CloudStatistics | undefined;
  /** Source units per step of the recorded integers, per axis: source coordinate = integer · scale + offset. */
  readonly scale: readonly [number, number, number];
  /** Source units, per axis. */
  readonly offset: readonly [number, number, number];
  /** Whether the points have colours of their own. */
  readonly hasColour: boolean;
  /** The octree as it lies on the globe. @internal */
  readonly globe: PlacedOctree;
  /** The octree as it lies in the planes of maps. @internal */
  readonly maps: MapOctrees;

  readonly #source: PointSource;
  readonly #extent: SourceExtent;
  #bounds: NodeBounds;
  readonly #truth: Truth;
  #accuracy!: StatedAccuracy;
  readonly #executor: NodeExecutor;
  readonly #ownsExecutor: boolean;
  readonly #shared: Opened["shared"];
  /** Ends what was asked for ahead of any view. */
  readonly #ahead: AbortController;
  #attributes:
    | { readonly appearance: Appearance | undefined; readonly list: readonly AttributeInfo[] }
    | undefined;
  /** Least and greatest height above WGS84, metres. */
  #heights: readonly [number, number];

  private constructor(opened: Opened, options: PointCloudOptions) {
    const { source, georeference, executor, shared, ahead } = opened;
    const { statistics, scale, attributes } = source;
    const { crs, sources, truth, tolerance } = georeference;
    this.#source = source;
    this.#shared = shared;
    this.#ahead = ahead;
    this.#truth = truth;
    this.name = baseName(source.name);
    this.pointCount = source.pointCount;
    this.identity = source.identity;
    this.crs = crs;
    this.height = crs.height;
    this.basis = georeference.basis;
    this.engine = georeference.engine;
    this.operation = georeference.operation;
    this.geoids = georeference.geoids;
    this.statistics = statistics;
    this.#extent = new SourceExtent(source);
    this.scale = scale;
    this.offset = source.offset;
    this.hasColour = attributes.some(({ name }) => name === "red") && statistics?.rgbBits !== null;
    const geometry = new NodeGeometry(source, truth, crs);
    this.#bounds = rootBounds(geometry, source.name, typeof truth === "function" ? crs.name : undefined);
    this.#heights = geometry.heights;
    this.#ownsExecutor = options.executor === undefined;
    this.#executor = executor;
    const limits = { ...options.limits, ...(options.budget && { budget: options.budget }) };
    const parts: OctreeParts = { source, executor, limits, ...this.#shared };
    const spec: DataSetSpec = {
      ...sources,
      file: source.name,
      encoding: source.encoding,
      bytesPerPoint: source.bytesPerPoint,
      scale,
      offset: source.offset,
      heights: [source.boundingBox.min[2], source.boundingBox.max[2]],
      ellipsoidalOrigin: this.#heights[0],
      tolerance,
    };
    const made = ({ extent }: NodeVertices) => this.#holdAgainst(extent);
    this.globe = new PlacedOctree(parts, { geometry, spec, made, appearance: recordedAppearance(source) });
    this.maps = new MapOctrees(parts, {
      ...{ truth, spec, crs, made },
      now: () => ({ boundingBox: this.boundingBox, appearance: this.globe.loader.appearance }),
      onGlobe: (key) => geometry.bounds(key) ?? this.#bounds,
    });
  }

  /**
   * Opens a data set: what it says of itself, its coordinate system and the root page of its hierarchy. The points of the
   * root are asked for and not waited for.
   * @param from an address, a `File` or `Blob`, or an own source of bytes
   * @throws StyleError STYLE_OPTION for an option that there is not, or that is none of its kind
   * @throws SourceError, FormatError, CrsError, PlacementError, RecordError; the signal's reason when aborted
   */
  static fromUrl(from: SourceLike, given: PointCloudOptions = {}): Promise<PointCloud> {
    return PointCloud.open(from, given, false);
  }

  /** The same for a view of the globe, where so: the root is decoded meanwhile. @internal */
  static async open(from: SourceLike, given: PointCloudOptions, onGlobe: boolean): Promise<PointCloud> {
    const options = checkCloudOptions(given);
    const { signal } = options;
    const executor = options.executor ?? new WorkerPool(options.workers);
    if (executor instanceof WorkerPool) executor.warm();
    const ahead = new AbortController();
    let cloud: PointCloud | undefined;
    try {
      const source = await openSource(from, options);
      const shared = sharedReads();
      const root = readRootAhead({ source, ...shared }, ahead.signal);
      const georeference = await georeferenceOf(source, options);
      signal?.throwIfAborted();
      cloud = new PointCloud({ source, georeference, executor, shared, ahead }, options);
      if (onGlobe) {
        cloud.globe.beginRoot(root);
        // A root that is here goes to a worker before this thread is busy with what that need not wait for.
        await nextTurn();
      }
      await cloud.globe.access.openRoot(signal);
      cloud.#accuracy = georeference.accuracy;
      signal?.throwIfAborted();
      return cloud;
    } catch (thrown) {
      ahead.abort(thrown);
      cloud?.destroy();
      if (!options.executor) executor.destroy();
      // Whatever an abort made fail on the way.
      throw signal?.aborted ? signal.reason : thrown;
    }
  }

  /** What a drawn position is worth: named parts and their sum, metres. */
  get accuracy(): StatedAccuracy {
    return this.#accuracy;
  }

  /** Brings nodes for views of the globe. @internal */
  get stream(): NodeStream {
    return this.globe.stream;
  }

  /** Box of all points, source units: as declared, or the octree's cube where that is found wrong. */
  get boundingBox(): SourceBox {
    return this.#extent.box;
  }

  /** Sphere around all points, ECEF, metres; `spacing` is that of the root. */
  get bounds(): NodeBounds {
    return this.#bounds;
  }

  /** What the data set says of itself and does not hold, as far as that is known by now. */
  get warnings(): readonly SourceWarning[] {
    return this.#extent.warnings;
  }

  /** What all nodes have in common, as far as it is known by now. @internal */
  get appearance(): Appearance | undefined {
    return this.globe.loader.appearance ?? this.maps.appearance;
  }

  /** The attributes of the points, with their ranges as far as they are known. */
  get attributes(): readonly AttributeInfo[] {
    const { appearance } = this;
    if (this.#attributes?.appearance !== appearance || !this.#attributes) {
      this.#attributes = { appearance, list: this.#listAttributes(appearance) };
    }
    return this.#attributes.list;
  }

  #listAttributes(appearance: Appearance | undefined): readonly AttributeInfo[] {
    const { min, max } = this.boundingBox;
    return attributesOf({
      ...{
        recorded: this.#source.attributes,
        hasColour: this.hasColour,
        verticalUnit: this.crs.verticalUnit,
      },
      ...{ elevations: [min[2], max[2]], heights: this.#heights, appearance },
    });
  }

  /**
   * Where a point is: source coordinates to ECEF by the map that the points are drawn by, exact, not fitted.
   * @param out receives X, Y, Z, metres
   * @throws PlacementError PLACE_DOMAIN where the data set's map has no such place
   */
  place(x: number, y: number, z: number, out: Float64Array = new Float64Array(3)): Float64Array {
    placePoint(this.#truth, x, y, z, out, this.#source.name);
    return out;
  }

  /**
   * The source coordinates of a place, to 1 µm: {@link place} backwards. Whether points lie there is not asked.
   * @param from what the place is given in. `ecef`: X, Y, Z, metres. `geodetic`: longitude, latitude (radians, WGS 84) and
   *   height above the ellipsoid (metres). The projection of a map: x and y in its units, height above the ellipsoid (metres)
   * @param out receives x, y, z, source units
   * @throws PlacementError PLACE_DOMAIN where no coordinates of the data set lead there
   * @throws CrsError CRS_UNSUPPORTED where proj4js does not know the projection
   */
  sourceOf(
    [x, y, z]: readonly [number, number, number],
    from: "ecef" | "geodetic" | PlaneOfMap = "ecef",
    out: Float64Array = new Float64Array(3),
  ): Float64Array {
    const { min, max } = this.boundingBox;
    const box = { minX: min[0], minY: min[1], maxX: max[0], maxY: max[1] };
    const truth = typeof from === "object" ? this.maps.truthIn(from) : this.#truth;
    const toSource = sourceTransform(truth, box, this.#source.name);
    if (from === "geodetic") geodeticToEcef(x, y, z, out);
    else if (from === "ecef") out.set([x, y, z]);
    else out.set([x * from.metresPerUnit, y * from.metresPerUnit, z]);
    toSource(out[0], out[1], out[2], out);
    return out;
  }

  /** Nodes of the octree that are known so far. */
  get nodeCount(): number {
    return this.globe.store.size;
  }

  /**
   * Loads one node, reading hierarchy pages on the way.
   * @param key the node, or its name `depth-x-y-z`
   * @throws FormatError FORMAT_NODE where the octree has no such node, or one without points
   * @throws SourceError, DecodeError, PlacementError; StyleError STYLE_OPTION; an AbortError after `destroy()`
   */
  async loadNode(
    key: VoxelKey | string,
    options: { signal?: AbortSignal | undefined } = {},
  ): Promise<NodeVertices> {
    const signal = checkSignal(options, this.#source.name);
    return this.globe.access.withPoints(key, signal, (node) => this.globe.loader.vertices(node, signal));
  }

  /**
   * One point exactly as it is recorded: its integers and all attributes, decoded again from the file.
   * @param from a node or batch, its key, or its name `depth-x-y-z`
   * @param point how many-th point in drawing order, or the index of its record in the chunk
   * @throws FormatError FORMAT_NODE where there is no such node or no such point in it
   * @throws SourceError, DecodeError; StyleError STYLE_OPTION; the signal's reason when aborted; an AbortError after `destroy()`
   */
  async readPoint(
    from: { readonly key: VoxelKey } | VoxelKey | string,
    point: number | { readonly record: number },
    options: { signal?: AbortSignal | undefined } = {},
  ): Promise<PointRecord> {
    const signal = checkSignal(options, this.#source.name);
    // A node may have left the octree since it was drawn: its key tells which one takes its place.
    const key = typeof from === "object" && "key" in from ? from.key : from;
    const { name, records } = await this.globe.access.withPoints(key, signal, async (node) => {
      return { name: node.name, records: await this.globe.loader.records(node, signal) };
    });
    const index = recordIndex(point, records.order, { node: name, file: this.#source.name });
    return pointRecord(name, index, records, this.#source);
  }

  /**
   * The recorded points of a part of the data set, complete and by whole nodes, whatever views show of it.
   * @throws StyleError STYLE_OPTION
   */
  query(options: QueryOptions = {}): PointQuery {
    const { globe } = this;
    const parts: QueryParts = {
      file: this.#source.name,
      withNode: (key, signal, work) => globe.access.withNode(key, signal, work),
      records: (node, signal) => globe.loader.records(node, signal),
      box: (key, out) => pointBox(this.#source, key, out),
      spacing: this.bounds.spacing,
      scale: this.scale,
      offset: this.offset,
    };
    return new PointQuery(parts, options);
  }

  /**
   * What a LAS file of some of the points begins and ends with; undefined where they are no LAS records.
   * @throws SourceError, FormatError; the signal's reason when aborted
   */
  async lasEnvelope(
    options: { readonly signal?: AbortSignal | undefined } = {},
  ): Promise<LasEnvelope | undefined> {
    return this.#source.lasEnvelope?.(options);
  }

  /** Stops all loading and ends the workers: what is read of points now or later throws an AbortError. */
  destroy(): void {
    this.#ahead.abort();
    this.globe.destroy();
    this.maps.destroy();
    for (const reads of Object.values(this.#shared)) reads.limit(0);
    if (this.#ownsExecutor) this.#executor.destroy();
  }

  /** Holds the points of a node against the box of all: where that is found wrong, all that follows from it is formed anew. */
  #holdAgainst(extent: ArrayLike<number>): void {
    if (!this.#extent.holdAgainst(extent)) return;
    this.globe.widen(this.boundingBox);
    this.maps.widen(this.boundingBox);
    this.#bounds = this.globe.bounds ?? this.#bounds;
    this.#heights = this.globe.geometry.heights;
    this.#attributes = undefined;
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
