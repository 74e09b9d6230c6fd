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
  type BoxRelation,
  guessHeights,
  type HeightData,
  type PointBatch,
  type PointBracket,
  PointCloud,
  type PointCloudOptions,
  type PointQuery,
  type PointRecord,
  type QueryOptions,
  type QueryVolume,
  type RecordValue,
  type StreamLimits,
} from "./cloud/index.js";
export { DecodeError, FormatError, type Outage, SourceError, StyleError } from "./errors/index.js";
export { SharedBudget, type SharedBudgetOptions, type VoxelKey } from "./octree/index.js";
export type {
  Address,
  AddressFunction,
  ByteSource,
  CloudStatistics,
  ExpiringHeaders,
  HeadersFunction,
  HeaderValues,
  HttpOptions,
  ReadOptions,
  RenewalContext,
  RetryPolicy,
  ServerWait,
  SourceBox,
  SourceLike,
  SourceWarning,
} from "./sources/index.js";
export {
  type Column,
  LazDecoder,
  type LazPerf,
  LocalExecutor,
  type NodeExecutor,
  type NodeRecords,
  type NodeVertices,
  type PoolOptions,
  WorkerPool,
} from "./workers/index.js";
