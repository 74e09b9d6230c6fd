export {
  guessHeights,
  type HeightData,
  PointCloud,
  type PointCloudOptions,
  type SourceBox,
  type StreamLimits,
} from "./cloud/index.js";
export { DecodeError, FormatError, SourceError, StyleError } from "./errors/index.js";
export type { ByteSource, CloudStatistics, HttpOptions, ReadOptions, SourceLike } from "./sources/index.js";
export {
  LazDecoder,
  type LazPerf,
  LocalExecutor,
  type NodeExecutor,
  type NodeVertices,
  type PoolOptions,
  VERTEX_STRIDE,
  WorkerPool,
} from "./workers/index.js";
