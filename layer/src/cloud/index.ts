export type { GeoreferenceOptions } from "./georeference.js";
export { NodeStream, type StreamLimits, type StreamListener, type StreamProgress } from "./node-stream.js";
export { PointCloud, type PointCloudOptions, type SourceBox } from "./point-cloud.js";
