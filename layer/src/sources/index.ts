export { BlobSource } from "./bytes/blob-source.js";
export { type ByteSource, isByteSource, type ReadOptions } from "./bytes/byte-source.js";
export { type HttpOptions, HttpSource } from "./bytes/http-source.js";
export { openBytes, type SourceLike } from "./bytes/open-bytes.js";
export type { RetryPolicy } from "./bytes/retry.js";
export { type CopcFile, openCopc, readHierarchyPage, readPageBytes } from "./copc/copc-file.js";
export type { CopcInfo, PageAddress } from "./copc/copc-info.js";
export {
  badHierarchy,
  ENTRY_LENGTH,
  type HierarchyEntry,
  type HierarchyLimits,
  parseHierarchyPage,
} from "./copc/hierarchy.js";
export {
  type AttributeStatistics,
  type CloudStatistics,
  decodeStatistics,
} from "./copc/statistics-record.js";
export type { ExtraBytes, NumberType } from "./las/extra-bytes.js";
export { BASE_RECORD_LENGTH, type LasHeader } from "./las/las-header.js";
