export type { AttributeInfo, PointRecord, RecordValue } from "./attribute-info.js";
export { CLOUD_OPTIONS, checkCloudOptions, type PointCloudOptions } from "./cloud-options.js";
export type { GeoreferenceOptions } from "./georeference-options.js";
export { guessHeights, type HeightData } from "./height-data.js";
export { loadProjections, type MapProjection, noPlace } from "./map-octrees.js";
export type { PlaneOfMap } from "./map-truth.js";
export { NodeStream, type StreamLimits, type StreamListener, type StreamProgress } from "./node-stream.js";
export type { PlacedOctree } from "./placed-octree.js";
export { POINT_CLOUD, PointCloud } from "./point-cloud.js";
