export { BlobSource } from "./bytes/blob-source.js";
export type { ByteSource, ReadOptions } from "./bytes/byte-source.js";
export { type HttpOptions, HttpSource } from "./bytes/http-source.js";
export { openBytes, type SourceLike } from "./bytes/open-bytes.js";
export type { RetryPolicy } from "./bytes/retry.js";
export { type Encoding, type OpenedSource, type OpenOptions, openSource } from "./open-source.js";
export type { NumberType, PointAttribute } from "./point-attribute.js";
export type { CrsDeclaration, HierarchyEntry, PointSource, SourceBox } from "./point-source.js";
export type { AttributeStatistics, CloudStatistics } from "./statistics.js";
