export { LazDecoder, type LazPerf } from "./laz-decoder.js";
export { LocalExecutor } from "./local-executor.js";
export { type PoolOptions, type WorkerLike, WorkerPool } from "./pool.js";
export {
  type DataSetSpec,
  type NodeExecutor,
  type NodeJob,
  type NodeVertices,
  VERTEX_STRIDE,
} from "./protocol.js";
