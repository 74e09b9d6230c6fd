export {
  type BoxClip,
  Clip,
  type ClipPlace,
  ClipSet,
  type PlaneClip,
  type PolygonClip,
} from "../clips/index.js";
export {
  type AttributeInfo,
  guessHeights,
  PointCloud,
  type PointCloudOptions,
  type PointRecord,
  type RecordValue,
  type StreamProgress,
} from "../cloud/index.js";
export type { GpuCounts, GpuKind } from "../drawing/gpu.js";
export {
  ASPRS_CLASSES,
  type ClassTable,
  type ColourBy,
  EFFECT_NAMES,
  type EffectName,
  type EyeDomeLighting,
  eyeDomeOf,
  type Forced,
  GRADIENTS,
  type GradientName,
  type GradientStop,
  type LedgerRow,
  type MeasuredCost,
  type PointCloudStyle,
  type PointFilter,
  type PointShape,
  type ReturnKind,
  type SizeMode,
  type StyleParts,
} from "../effects/index.js";
export type { Outage } from "../errors/index.js";
export { SharedBudget, type SharedBudgetOptions } from "../octree/index.js";
export type {
  Address,
  AddressFunction,
  ExpiringHeaders,
  HeadersFunction,
  HeaderValues,
  HttpOptions,
  RenewalContext,
  RetryPolicy,
  ServerWait,
} from "../sources/index.js";
export type { LayerSource, LayerStatistics, PickResult, PointCloudLayerOptions } from "./layer-options.js";
export type { PickOptions } from "./layer-renderer.js";
export { PointCloudLayer } from "./point-cloud-layer.js";
