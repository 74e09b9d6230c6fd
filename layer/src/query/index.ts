export { type ChunkFormat, LazModule } from "../laz/index.js";
export { NodeAccess, type NodeAccessParts, noNode } from "./node-access.js";
export { nodeCube, pointBox } from "./node-cube.js";
export { openPage } from "./open-page.js";
export { Pace } from "./pace.js";
export {
  type BoxRelation,
  classesOf,
  everyRecord,
  ofClasses,
  type PointBatch,
  type PointBracket,
  PointQuery,
  type QueryOptions,
  type QueryParts,
  type QueryVolume,
} from "./point-query.js";
export { type GeodeticPlace, recordNumbers } from "./record-numbers.js";
export {
  type PointOrigin,
  RecordedPoints,
  type RecordedPointsOptions,
  type RecordQuery,
} from "./recorded-points.js";
