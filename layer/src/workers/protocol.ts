import type { FaultWire, Frame, MapPlane, Scheme, TruthSources } from "@groma/georef";
import type { Encoding } from "../sources/open-source.js";
import type { StoredAttribute } from "./stored-attribute.js";

/** How a data set is stored: all that is needed to decode its points. */
export interface StorageSpec {
  /** Name of the file, for errors. */
  readonly file: string;
  /** How chunks are encoded, and so which decoder they get. */
  readonly encoding: Encoding;
  /** Bytes that a decoded point takes; a node of too many is refused. */
  readonly bytesPerPoint: number;
  /** Source units per integer step, per axis. */
  readonly scale: readonly [number, number, number];
  /** Source units, per axis. */
  readonly offset: readonly [number, number, number];
}

/** What a worker must know of a data set, once, before it takes jobs for it: how it is stored, and where it is. */
export interface DataSetSpec extends TruthSources, StorageSpec {
  /** Least and greatest height that is declared, source units. */
  readonly heights: readonly [number, number];
  /** Height above WGS84 that the column `ellipsoidalHeight` counts from, metres. */
  readonly ellipsoidalOrigin: number;
  /** Greatest distance of a drawn point from its exact place, metres. */
  readonly tolerance: number;
  /** The plane of a map that its points are placed in. Default: they are placed on the globe. */
  readonly plane?: MapPlane | undefined;
}

/** What must be the same for all nodes of a data set, or its nodes would not match in colour. */
export interface Appearance {
  /** Bits per colour channel that the scan really uses. */
  readonly rgbBits: 8 | 16;
  /** Whether the bits are known of all points, or judged by those seen so far: 8 then lasts until one needs 16. */
  readonly rgbBitsKnown: boolean;
  /** Least and greatest value by column name, in the attribute's unit; what float32 columns count from is the least. */
  readonly ranges: ReadonlyMap<string, readonly [number, number]>;
}

/** One node's chunk of encoded points, as the source gives it. */
export interface ChunkJob {
  readonly dataSet: number;
  readonly chunk: ArrayBuffer;
  /** CRC-32C of the chunk as stored; undefined where there is none. */
  readonly checksum?: number | undefined;
  readonly pointCount: number;
  /** Node name, for errors. */
  readonly node: string;
  /** Cube of the node in source coordinates: min x, y, z and edge. Points far outside it mean damage. */
  readonly cube: readonly [number, number, number, number];
}

/** One node's work: a chunk of encoded points that becomes vertices. */
export interface NodeJob extends ChunkJob {
  /** Undefined: to be judged by this node's own points. */
  readonly appearance: Appearance | undefined;
}

/** Values of a column as they go to the GPU. */
export type ColumnData =
  | Uint8Array
  | Int8Array
  | Uint16Array
  | Int16Array
  | Uint32Array
  | Int32Array
  | Float32Array;

/**
 * One attribute of all points of a node, in drawing order. The value of a point is stored · scale + offset, or
 * `constant` for all of them.
 */
export interface Column {
  readonly name: string;
  readonly components: 1 | 2 | 3 | 4;
  /** `components` numbers per point; empty where `constant` is given. */
  readonly data: ColumnData;
  readonly scale: number;
  readonly offset: number;
  /** The value that all points have, in the attribute's unit; NaN where none of them has one. */
  readonly constant?: readonly number[];
  /** The stored number that means "no value". */
  readonly noData?: number;
  /** Greatest distance of a value from the record's, in the attribute's unit. */
  readonly bound: number;
}

/** Where a node that is placed on a map lies on the globe: what volumes, which stand there, are held against. */
export interface NodeOnGlobe {
  /** East-north-up at the middle of the node's points: local metres → ECEF. */
  readonly frame: Frame;
  /** Box in that frame that the points lie in: min x, y, z, max x, y, z, metres. */
  readonly box: Float32Array;
  /** Affine map, 3 rows of 4: node frame on the map → that frame, metres. */
  readonly fromMap: Float32Array;
  /** Greatest distance of a place from its exact one, metres, as far as was looked. */
  readonly error: number;
}

/**
 * A node ready to be drawn. All typed arrays but `box`, `extent`, `toCube`, those of `onGlobe` and the frame's are views of one {@link buffer},
 * which is transferred.
 */
export interface NodeVertices {
  readonly buffer: ArrayBuffer;
  /** East, north, up of each point: float32, metres in the node frame, drawing order. */
  readonly positions: Float32Array;
  /**
   * Attributes by name: `rgb` (RGBA, 0 to 255), `nir`, `intensity`, `returnNumber`, `numberOfReturns`,
   * `classification`, `flags` (byte 15 of the record), `scanAngle` (degrees), `userData`, `pointSourceId`, `gpsTime`
   * (seconds), `elevation` (source z), `ellipsoidalHeight` (metres), and each numeric extra bytes attribute under its
   * own name. A column is absent where the point format has no such attribute.
   */
  readonly columns: ReadonlyMap<string, Column>;
  /** Bits per channel by which the column `rgb` was made. */
  readonly rgbBits: 8 | 16;
  /** Index in the chunk of each drawn point. Every prefix of the drawing order is an even sample of the node. */
  readonly order: Uint16Array | Uint32Array;
  readonly count: number;
  /** Node frame: local metres → ECEF; on a map, local metres → the plane and the height. */
  readonly frame: Frame;
  /** Least and greatest position in the node frame: min x, y, z, max x, y, z, metres. */
  readonly box: Float32Array;
  /** Least and greatest source coordinates of the points: min x, y, z, max x, y, z. */
  readonly extent: Float64Array;
  /** Certified distance of a stored position from its exact place, metres. */
  readonly bound: number;
  /**
   * Length that all coordinates of positions are whole multiples of, less than 2²⁰ of them, metres: a power of two, so that
   * they go to the GPU in 8 bytes a point without a further error. Undefined where steps would leave the tolerance.
   */
  readonly step: number | undefined;
  readonly scheme: Scheme;
  /** Affine map, 3 rows of 4: node frame metres → the node's cube in the octree, [0, 1] per axis. */
  readonly toCube: Float32Array;
  /** Greatest distance of a point's place in the cube from its exact one, per axis, as share of the cube. */
  readonly toCubeError: number;
  /** Of a node that is placed on a map; undefined where it has no place on the globe. */
  readonly onGlobe?: NodeOnGlobe | undefined;
  /** What the node's own points look like; only where the job gave no appearance. */
  readonly seen: Appearance | undefined;
  /** Bytes of {@link buffer}. */
  readonly bytes: number;
}

/** A node's points as recorded, in the order of the chunk. */
export interface RecordedNode {
  readonly count: number;
  /** x, y and z of each point: the integers that the source's scale and offset turn into coordinates. */
  readonly xyz: Int32Array;
  /** All attributes that the source names. */
  readonly attributes: readonly StoredAttribute[];
  /** The LAS records themselves, one after the other, where points are such; attributes may share their bytes. */
  readonly lasRecords?: Uint8Array | undefined;
}

/** The same with the order in which they are drawn. The buffers of all arrays are transferred. */
export interface NodeRecords extends RecordedNode {
  /** Index in the chunk of each drawn point; as {@link NodeVertices.order}. */
  readonly order: Uint16Array | Uint32Array;
}

/** From the page to a worker. */
export type WorkerRequest =
  | { readonly kind: "dataSet"; readonly id: number; readonly spec: DataSetSpec }
  | { readonly kind: "forget"; readonly id: number }
  | { readonly kind: "node"; readonly id: number; readonly job: NodeJob }
  | { readonly kind: "records"; readonly id: number; readonly job: ChunkJob };

/** From a worker to the page. */
export type WorkerReply =
  | { readonly kind: "vertices"; readonly id: number; readonly result: NodeVertices }
  | { readonly kind: "records"; readonly id: number; readonly result: NodeRecords }
  | { readonly kind: "failed"; readonly id: number; readonly fault: FaultWire };

/** Whatever carries out jobs: a pool of workers in a page, the same thread in a test or a tool. */
export interface NodeExecutor {
  /** Makes a data set known; the number returned is what jobs refer to. */
  addDataSet(spec: DataSetSpec): number;
  removeDataSet(id: number): void;
  /** Decodes, places and packs. @throws DecodeError, PlacementError; the signal's reason when aborted */
  run(job: NodeJob, signal?: AbortSignal): Promise<NodeVertices>;
  /** Decodes only. @throws DecodeError; the signal's reason when aborted */
  records(job: ChunkJob, signal?: AbortSignal): Promise<NodeRecords>;
  /** Jobs accepted and not yet answered. */
  readonly pending: number;
  destroy(): void;
}
