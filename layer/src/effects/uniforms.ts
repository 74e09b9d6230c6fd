import { EFFECTS } from "./catalogue.js";
import type { EffectPlan } from "./effect-plan.js";
import type { SceneFacts } from "./facts.js";
import type { PointCloudStyle } from "./style.js";

export type UniformValues = Readonly<Record<string, number | readonly number[]>>;

/** Values of the uniforms that hold for all nodes of a layer; matrices are column-major. */
export function layerUniforms(plan: EffectPlan, style: PointCloudStyle, facts: SceneFacts): UniformValues {
  const scene = { style, facts };
  const values: Record<string, number | readonly number[]> = {};
  for (const effect of EFFECTS) {
    if (plan.active.has(effect.name)) Object.assign(values, effect.values?.(scene, plan));
  }
  return values;
}
