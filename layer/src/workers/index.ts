export { constantColumn, halfUlp32 } from "./column-plan.js";
export { type Decoders, decodersWith } from "./decoders.js";
export { LazDecoder } from "./laz-decoder.js";
export { LocalExecutor } from "./local-executor.js";
export { cubeSlack, decodeNode } from "./node-job.js";
export { checkNodeSize } from "./node-size.js";
export type { DecodedPoints, Encoded, Expected, PointDecoder } from "./point-decoder.js";
export { type PoolOptions, type WorkerLike, WorkerPool } from "./pool.js";
export type {
  Appearance,
  ChunkJob,
  Column,
  ColumnData,
  DataSetSpec,
  NodeExecutor,
  NodeJob,
  NodeOnGlobe,
  NodeRecords,
  NodeVertices,
  RecordedNode,
  StorageSpec,
  WorkerReply,
  WorkerRequest,
} from "./protocol.js";
export { colourBits, recordedColumn } from "./record-columns.js";
export { readCoordinates } from "./records.js";
export { exactValue, type StoredAttribute, valueReader, viewOf } from "./stored-attribute.js";
