// What the entry of each view exports, besides its own layer.
export type { Vector } from "@groma/georef";
export type { CameraView } from "./camera/index.js";
export type { DrawingOptions, PickOptions } from "./drawing/drawing-options.js";
export type { DrawnStatistics } from "./drawing/drawn-statistics.js";
export type { GpuCounts, GpuKind } from "./drawing/gpu.js";
export {
  ASPRS_CLASSES,
  type ClassTable,
  type ColourBy,
  EFFECT_NAMES,
  type EffectName,
  type EyeDomeLighting,
  type EyeDomeStyle,
  eyeDomeOf,
  type Forced,
  GRADIENTS,
  type GradientName,
  type GradientStop,
  type LedgerRow,
  type MeasuredCost,
  type PointClass,
  type PointCloudStyle,
  type PointFilter,
  type PointShape,
  type ReturnKind,
  type SizeMode,
  type StyleParts,
} from "./effects/index.js";
export * from "./index.js";
export {
  type DrawnCloud,
  layerView,
  readPermalink,
  type SharedEquation,
  type SharedProfile,
  type SharedView,
  type ViewedLayer,
  writePermalink,
} from "./permalink/index.js";
export type {
  DatasetName,
  MeasuredCloud,
  ScreenPoint,
  Terrain,
  Vertex,
  VertexRecord,
  ViewAdapter,
} from "./tools/index.js";
