export type { AttributeInfo, PointRecord, RecordValue } from "./attribute-info.js";
export { CLOUD_OPTIONS, checkCloudOptions, type PointCloudOptions } from "./cloud-options.js";
export type { GeoreferenceOptions } from "./georeference.js";
export { guessHeights, type HeightData } from "./height-data.js";
export { type MapProjection, noPlace, type PlaneOfMap } from "./map-octrees.js";
export { NodeStream, type StreamLimits, type StreamListener, type StreamProgress } from "./node-stream.js";
export type { PlacedOctree } from "./placed-octree.js";
export { POINT_CLOUD, PointCloud } from "./point-cloud.js";
