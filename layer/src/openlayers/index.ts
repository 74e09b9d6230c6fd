export * from "../every-view.js";
export type { PointCloudLayerOptions } from "./layer-options.js";
export { measureView } from "./measure-view.js";
export {
  type LayerStatistics,
  type PickResult,
  PointCloudLayer,
} from "./point-cloud-layer.js";
export {
  PointCloudErrorEvent,
  PointCloudSource,
  type PointCloudSourceOptions,
} from "./point-cloud-source.js";
