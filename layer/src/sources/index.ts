export { BlobSource } from "./blob-source.js";
export { type ByteSource, isByteSource, type ReadOptions } from "./byte-source.js";
export { type CopcFile, openCopc, readHierarchyPage, readPageBytes } from "./copc-file.js";
export type { CopcInfo, PageAddress } from "./copc-info.js";
export type { ExtraBytes, NumberType } from "./extra-bytes.js";
export {
  badHierarchy,
  ENTRY_LENGTH,
  type HierarchyEntry,
  type HierarchyLimits,
  parseHierarchyPage,
} from "./hierarchy.js";
export { type HttpOptions, HttpSource } from "./http-source.js";
export { BASE_RECORD_LENGTH, type LasHeader } from "./las-header.js";
export { openSource, type SourceLike } from "./open-source.js";
export type { RetryPolicy } from "./retry.js";
export {
  type AttributeStatistics,
  type CloudStatistics,
  decodeStatistics,
} from "./statistics-record.js";
