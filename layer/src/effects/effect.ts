import type { EffectName, EffectPlan } from "./effect-plan.js";
import type { Part, PartContext } from "./part.js";
import type { Scene } from "./scene.js";

/** Whether a scene asks for an effect: `asked` and `auto` run from the threshold on, `forced` always, `off` never. */
export interface Wish {
  readonly kind: "asked" | "auto" | "forced" | "off";
  readonly why: string;
}

/** A part of the picture that could be left out. */
export interface Effect {
  readonly name: EffectName;
  readonly unit: "px" | "share" | "1" | "m" | "levels";
  /** From this magnitude on it runs. */
  readonly threshold: number;
  /** Formula of the magnitude and where it comes from. */
  readonly source: string;
  wish(scene: Scene): Wish;
  /** How much the picture would change without it, in {@link unit}. */
  magnitude(scene: Scene): number;
  /** What it adds to the point program of a pass; undefined where nothing. */
  part?(context: PartContext): Part | undefined;
  /** Values of its uniforms that hold for all nodes. */
  values?(scene: Scene, plan: EffectPlan): Readonly<Record<string, number | readonly number[]>>;
}
