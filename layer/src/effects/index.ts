export { type EyeDomeLighting, type EyeDomeStyle, eyeDomeOf } from "./catalogue/eye-dome-lighting.js";
export {
  type ColourBy,
  EFFECT_NAMES,
  type EffectName,
  type PointCloudStyle,
  type PointShape,
  type SizeMode,
} from "./catalogue/index.js";
export { composePointShader, nodeLayoutOf } from "./compose.js";
export { composeQuad } from "./compose-quad.js";
export { ASPRS_CLASSES, type ClassTable, type PointClass } from "./declaration/classes.js";
export { OFFSET } from "./declaration/colouring.js";
export { footprint, spacingOf } from "./declaration/drawn-spacing.js";
export type { ColumnScale, PlacingFacts, SceneFacts, StyledNode } from "./declaration/facts.js";
export {
  checkFilter,
  type FilteredNumbers,
  type PointFilter,
  type ReturnKind,
  recordTest,
} from "./declaration/filter.js";
export { GRADIENTS, type GradientName, type GradientStop } from "./declaration/gradients.js";
export type { StyledAttribute, StyledCloud } from "./declaration/option.js";
export {
  type AttributeDeclaration,
  CLIP_RECORDS,
  FIRST_ID,
  FRONT,
  OCTREE_INDEX,
  type PointPass,
  type PointShader,
  type QuadShader,
  type ShaderTarget,
  type TextureData,
  type UniformDeclaration,
  type UniformType,
  type UniformValues,
} from "./declaration/shader.js";
export {
  columnMajor,
  encodeVisibleOctree,
  type VisibleNode,
  type VisibleOctree,
} from "./declaration/visible-octree.js";
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
export { groundSpacing } from "./ground-spacing.js";
export {
  NODE_NUMBER,
  NODE_TABLE,
  NODE_TABLE_WIDTH,
  type NodeLayout,
  type NodeValues,
  placeIn,
  writeInteger,
  writeMatrix,
  writeNode,
} from "./node-layout.js";
export {
  type CloudPlacing,
  cloudPlacing,
  type PlacedCloud,
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
export { type PaintStyle, type PointPaint, pointPaint } from "./point-paint.js";
export { inSteps } from "./stored-positions.js";
export { completeStyle, defaultStyle, type StyleParts } from "./style.js";
export { WEBGL2 } from "./webgl2-target.js";
