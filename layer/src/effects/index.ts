export { checkFilter } from "./check-filter.js";
export { ASPRS_CLASSES, type ClassTable, type PointClass } from "./classes.js";
export { completeStyle, type StyledCloud, type StyleParts } from "./complete-style.js";
export { composePointShader } from "./compose.js";
export { composePass } from "./compose-pass.js";
export { drawnSpacing, footprint } from "./drawn-spacing.js";
export {
  type Colouring,
  drawsOffscreen,
  EFFECT_NAMES,
  type EffectName,
  type EffectPlan,
  type LedgerRow,
  type MeasuredCost,
} from "./effect-plan.js";
export type { PlacingFacts, SceneFacts, StyledAttribute } from "./facts.js";
export { type PointFilter, passesFilter, type ReturnKind } from "./filter.js";
export { GRADIENTS, type GradientName, type GradientStop } from "./gradients.js";
export { groundSpacing, type Patch } from "./ground-spacing.js";
export { type ColumnScale, type DrawnNode, nodeUniforms } from "./node-uniforms.js";

export {
  type CloudPlacing,
  cloudPlacing,
  type PlacedCloud,
  type PlacedNode,
  placingFacts,
} from "./placing-facts.js";
export { asksForSilhouettes, type Forced, planEffects, withoutClips } from "./plan.js";
export type {
  AttributeDeclaration,
  PointPass,
  PointShader,
  QuadPass,
  QuadShader,
  ShaderTarget,
  UniformDeclaration,
  UniformType,
} from "./shader-target.js";
export {
  type ColourBy,
  defaultStyle,
  type EyeDomeLighting,
  eyeDomeOf,
  type PointCloudStyle,
  type PointShape,
  type SizeMode,
} from "./style.js";
export { styleTextures, type TextureData } from "./textures.js";
export { layerUniforms, type UniformValues } from "./uniforms.js";
export { encodeVisibleOctree, type VisibleNode, type VisibleOctree } from "./visible-octree.js";
