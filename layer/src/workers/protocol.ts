import type { FaultWire, Frame, Scheme, TruthSources } from "@groma/georef";

/** What a worker must know of a data set, once, before it takes jobs for it: where it is, and how it is stored. */
export interface DataSetSpec extends TruthSources {
  /** Name of the file, for errors. */
  readonly file: string;
  /** Point data record format: 6, 7 or 8. */
  readonly pointFormat: number;
  /** Bytes per record, extra bytes included. */
  readonly recordLength: number;
  /** Source units per integer step, per axis. */
  readonly scale: readonly [number, number, number];
  /** Source units, per axis. */
  readonly offset: readonly [number, number, number];
  /** Heights that elevation 0 and 65535 stand for, source units. */
  readonly heights: readonly [number, number];
  /** Greatest distance of a drawn point from its exact place, metres. */
  readonly tolerance: number;
}

/** One node's work: a chunk of compressed points that becomes vertices. */
export interface NodeJob {
  readonly dataSet: number;
  /** Compressed chunk as it lies in the file. */
  readonly chunk: ArrayBuffer;
  readonly pointCount: number;
  /** Node name, for errors. */
  readonly node: string;
  /** Cube of the node in source coordinates: min x, y, z and edge. Points far outside it mean damage. */
  readonly cube: readonly [number, number, number, number];
  /** Bits per colour channel; undefined: to be judged by this node's own colours. */
  readonly rgbBits: 8 | 16 | undefined;
}

/** Bytes per vertex; see {@link NodeVertices.vertices}. */
export const VERTEX_STRIDE = 20;

/** A node ready to be drawn. */
export interface NodeVertices {
  /**
   * Interleaved vertices of {@link VERTEX_STRIDE} bytes, in the order of the records in the chunk: position (3 float32,
   * metres in the node frame), colour (4 uint8, RGBA), intensity (uint16), elevation (uint16, 0 to 65535 over the
   * data set's heights). Transferred.
   */
  readonly vertices: ArrayBuffer;
  readonly count: number;
  /** Node frame: local metres → ECEF. */
  readonly frame: Frame;
  /** Least and greatest position in the node frame: min x, y, z, max x, y, z, metres. */
  readonly box: Float32Array;
  /** Certified distance of a stored position from its exact place, metres. */
  readonly bound: number;
  readonly scheme: Scheme;
  /** What was seen in the records: the base for judging colours and intensities of a data set without statistics. */
  readonly seen: { readonly colourMax: number; readonly intensityMin: number; readonly intensityMax: number };
}

/** From the page to a worker. */
export type WorkerRequest =
  | { readonly kind: "dataSet"; readonly id: number; readonly spec: DataSetSpec }
  | { readonly kind: "forget"; readonly id: number }
  | { readonly kind: "node"; readonly id: number; readonly job: NodeJob };

/** From a worker to the page. */
export type WorkerReply =
  | { readonly kind: "done"; readonly id: number; readonly result: NodeVertices }
  | { readonly kind: "failed"; readonly id: number; readonly fault: FaultWire };

/** Whatever carries out node jobs: a pool of workers in a page, the same thread in a test or a tool. */
export interface NodeExecutor {
  /** Makes a data set known; the number returned is what jobs refer to. */
  addDataSet(spec: DataSetSpec): number;
  removeDataSet(id: number): void;
  /** @throws DecodeError, PlacementError; the signal's reason when aborted */
  run(job: NodeJob, signal?: AbortSignal): Promise<NodeVertices>;
  /** Jobs accepted and not yet answered. */
  readonly pending: number;
  destroy(): void;
}
