import { type AnyEffect, EFFECTS, type EffectName, type PointCloudStyle } from "./catalogue/index.js";
import type { Scene } from "./declaration/effect.js";
import type { StyledNode } from "./declaration/facts.js";
import type { PointPass, TextureData, UniformValues } from "./declaration/shader.js";
import { STEP } from "./stored-positions.js";

/** What an effect takes, measured. */
export interface MeasuredCost {
  /** Below zero where it takes less with the effect than without, as where fewer fragments are left to draw. */
  readonly value: number;
  readonly unit: "ms per frame" | "ns per point" | "bytes";
  /** How it was measured. */
  readonly by: "timer query" | "frame difference" | "count";
}

/** One line of `layer.ledger`. */
export interface LedgerRow {
  /** An {@link EffectName}, or the name of an effect of placing. */
  readonly effect: string;
  /** How much the picture or the place would change without it; NaN where the facts do not say. */
  readonly magnitude: number;
  readonly unit: string;
  /** What the magnitude is held against. */
  readonly threshold: number;
  readonly active: boolean;
  readonly why: string;
  /** Formula of the magnitude and where it comes from. */
  readonly source: string;
  /** Undefined until measured; inactive effects cost nothing. */
  readonly cost: MeasuredCost | undefined;
}

/** The effects that a scene calls for, and why. */
export interface EffectPlan {
  readonly active: ReadonlySet<EffectName>;
  /** Same key, same programs. */
  readonly key: string;
  readonly ledger: readonly LedgerRow[];
  /** What it was made for. */
  readonly scene: Scene<PointCloudStyle>;
  /** What the programs of effects depend on, besides which of them run. */
  readonly variants: ReadonlyMap<EffectName, unknown>;
}

/** The effects that run, in the order of the catalogue. */
export function effectsOf({ active }: Pick<EffectPlan, "active">): AnyEffect[] {
  return EFFECTS.filter(({ name }) => active.has(name));
}

/** How a plan's picture comes about. */
export interface Passes {
  /** The passes over the points. */
  readonly points: readonly [PointPass, ...PointPass[]];
  /** Whether they fill a picture of their own that a quad then puts into the scene. */
  readonly offscreen: boolean;
  /** Whether later passes read the depths that the first one drew. */
  readonly readsFront: boolean;
  /** Whether the scene shows through. */
  readonly translucent: boolean;
}

/** The passes that the effects of a plan are drawn in. */
export function passesOf(plan: Pick<EffectPlan, "active" | "variants">): Passes {
  const effects = effectsOf(plan);
  const own = effects.map(({ pass }) => pass).find((pass) => typeof pass === "object");
  return {
    points: own ?? ["color"],
    offscreen: effects.some(({ pass = "points" }) => pass !== "points"),
    readsFront: effects.some((effect) => effect.readsFront?.(plan.variants.get(effect.name))),
    translucent: effects.some(({ translucent }) => translucent),
  };
}

/** Whether a plan reads a texture about the nodes that are drawn. */
export function readsNodeTexture(plan: Pick<EffectPlan, "active">, texture: "octree" | "clips"): boolean {
  return effectsOf(plan).some(({ nodeTexture }) => nodeTexture === texture);
}

/** Values of the uniforms that hold for all nodes of a layer. */
export function layerUniforms(plan: EffectPlan): UniformValues {
  return Object.assign({}, ...effectsOf(plan).map((effect) => effect.values?.(plan.scene)));
}

/** Effects that have uniforms of nodes. */
const OF_NODES = EFFECTS.filter(({ nodeValues }) => nodeValues !== undefined);

/** Values of the uniforms of one node that stay until its points, the style or the filter change. */
export function nodeUniforms(plan: EffectPlan, node: StyledNode): UniformValues {
  const values: Record<string, number | readonly number[]> = { [STEP.name]: node.step ?? 1 };
  for (const effect of OF_NODES) {
    if (plan.active.has(effect.name)) Object.assign(values, effect.nodeValues?.(plan.scene, node));
  }
  return values;
}

/**
 * Textures that the style and the filter fill; those of the visible octree and of clips belong to the nodes drawn. To be
 * formed anew when the style or the filter changes.
 */
export function styleTextures(plan: EffectPlan): TextureData[] {
  const textures = effectsOf(plan).flatMap((effect) => effect.textures?.(plan.scene) ?? []);
  return [...new Map(textures.map((texture) => [texture.name, texture] as const)).values()];
}
