export {
  guessHeights,
  type HeightData,
  PointCloud,
  type PointCloudOptions,
  type StreamProgress,
} from "../cloud/index.js";
export { type LayerStatistics, PointCloudLayer, type PointCloudLayerOptions } from "./point-cloud-layer.js";
export type { LayerSource } from "./source-from-resource.js";
export type { ColourBy, PointCloudStyle } from "./style.js";
