export { BlobSource } from "./bytes/blob-source.js";
export type { ByteSource, ReadOptions } from "./bytes/byte-source.js";
export type {
  Address,
  AddressFunction,
  ExpiringHeaders,
  HeadersFunction,
  HeaderValues,
} from "./bytes/credentials.js";
export type { ServerWait } from "./bytes/host-schedule.js";
export { type HttpOptions, HttpSource, type RetryPolicy } from "./bytes/http-source.js";
export { openBytes, type SourceLike } from "./bytes/open-bytes.js";
export type { RenewalContext } from "./bytes/renewable.js";
export { checkChecksum } from "./contract/checksum.js";
export type { NumberType, PointAttribute } from "./contract/point-attribute.js";
export type {
  CrsDeclaration,
  EncodedChunk,
  HierarchyEntry,
  LasEnvelope,
  LasVariableRecord,
  PointSource,
  SourceBox,
  SourceWarning,
} from "./contract/point-source.js";
export type { AttributeStatistics, CloudStatistics } from "./contract/statistics.js";
export { decodeStatistics } from "./copc/statistics-record.js";
export { type Encoding, type OpenedSource, type OpenOptions, openSource } from "./open-source.js";
