export { type EyeDomeLighting, type EyeDomeStyle, eyeDomeOf } from "./catalogue/eye-dome-lighting.js";
export {
  type ColourBy,
  EFFECT_NAMES,
  type EffectName,
  type PointCloudStyle,
  type PointShape,
  type SizeMode,
} from "./catalogue/index.js";
export { ASPRS_CLASSES, type ClassTable, type PointClass } from "./classes.js";
export { composePointShader } from "./compose.js";
export { composeQuad } from "./compose-quad.js";
export { drawnSpacing, footprint } from "./drawn-spacing.js";
export {
  type EffectPlan,
  type LedgerRow,
  layerUniforms,
  type MeasuredCost,
  nodeUniforms,
  type Passes,
  passesOf,
  readsNodeTexture,
  styleTextures,
} from "./effect-plan.js";
export type { ColumnScale, DrawnNode, PlacingFacts, SceneFacts } from "./facts.js";
export { checkFilter, type PointFilter, passesFilter, type ReturnKind } from "./filter.js";
export { GRADIENTS, type GradientName, type GradientStop } from "./gradients.js";
export { groundSpacing, type Patch } from "./ground-spacing.js";
export type { StyledAttribute, StyledCloud } from "./option.js";
export {
  type CloudPlacing,
  cloudPlacing,
  type PlacedCloud,
  type PlacedNode,
  placingFacts,
} from "./placing-facts.js";
export {
  asksForSilhouettes,
  checkForced,
  type Forced,
  planEffects,
  widestPoint,
  withoutClips,
} from "./plan.js";
export type {
  AttributeDeclaration,
  PointPass,
  PointShader,
  QuadShader,
  ShaderTarget,
  TextureData,
  UniformDeclaration,
  UniformType,
  UniformValues,
} from "./shader.js";
export { completeStyle, defaultStyle, type StyleParts } from "./style.js";
export { encodeVisibleOctree, type VisibleNode, type VisibleOctree } from "./visible-octree.js";
