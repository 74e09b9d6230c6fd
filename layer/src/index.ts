export {
  type BoxClip,
  Clip,
  type ClipPlace,
  ClipSet,
  type PlaneClip,
  type PolygonClip,
} from "./clips/index.js";
export {
  type AttributeInfo,
  guessHeights,
  type HeightData,
  PointCloud,
  type PointCloudOptions,
  type PointRecord,
  type RecordValue,
  type StreamLimits,
} from "./cloud/index.js";
export { DecodeError, FormatError, SourceError, StyleError } from "./errors/index.js";
export { SharedBudget, type SharedBudgetOptions, type VoxelKey } from "./octree/index.js";
export type {
  ByteSource,
  CloudStatistics,
  HttpOptions,
  ReadOptions,
  SourceBox,
  SourceLike,
} from "./sources/index.js";
export {
  type Column,
  LazDecoder,
  type LazPerf,
  LocalExecutor,
  type NodeExecutor,
  type NodeVertices,
  type PoolOptions,
  WorkerPool,
} from "./workers/index.js";
