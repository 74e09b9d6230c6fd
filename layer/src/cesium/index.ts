export type { GpuMilliseconds } from "../drawing/frame.js";
export * from "../every-view.js";
export { cameraView, showCameraView } from "./camera-view.js";
export type {
  LayerSource,
  PickResult,
  PointCloudLayerOptions,
  WindowPosition,
} from "./layer-options.js";
export type { LayerStatistics } from "./layer-statistics.js";
export { measureView } from "./measure-view.js";
export { PointCloudLayer } from "./point-cloud-layer.js";
export { type TerrainOfOptions, terrainOf } from "./terrain.js";
