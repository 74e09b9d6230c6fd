import type { EffectPlan } from "../effects/index.js";
import type { ViewTypes } from "./drawn-node.js";
import type { Gpu } from "./gpu.js";
import { Material } from "./material.js";

/**
 * The material that is drawn, and the next one: a new style shows once all that it needs is there, and not node by node.
 */
export class Materials<V extends ViewTypes> {
  readonly #gpu: Gpu<V>;
  readonly #base: V["uniforms"];
  #shown: Material<V> | undefined;
  #next: Material<V> | undefined;

  /** @param base uniforms that the view itself fills */
  constructor(gpu: Gpu<V>, base: V["uniforms"]) {
    this.#gpu = gpu;
    this.#base = base;
  }

  /** What is drawn. */
  get shown(): Material<V> | undefined {
    return this.#shown;
  }

  /** What is being prepared. */
  get next(): Material<V> | undefined {
    return this.#next;
  }

  /** The material of a set of effects: the one that is drawn, or one that is being prepared from now on. */
  want(plan: EffectPlan): Material<V> {
    if (this.#shown?.plan.key === plan.key) {
      this.#next?.destroy();
      this.#next = undefined;
      return this.#shown;
    }
    if (this.#next?.plan.key !== plan.key) {
      this.#next?.destroy();
      this.#next = new Material(this.#gpu, plan, this.#base);
    }
    return this.#next;
  }

  /** What was being prepared is drawn from now on. */
  change(): void {
    if (!this.#next) return;
    this.#shown?.destroy();
    this.#shown = this.#next;
    this.#next = undefined;
  }

  destroy(): void {
    this.#shown?.destroy();
    this.#next?.destroy();
  }
}
