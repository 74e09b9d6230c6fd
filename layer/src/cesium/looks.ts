import type { EffectPlan } from "../effects/index.js";
import type { UniformMap } from "./engine/cesium-private.js";
import type { GpuObjects } from "./engine/gpu-objects.js";
import { Look } from "./look.js";

/** The look that is drawn, and one to come: a new style shows once all that it needs is there, and not node by node. */
export class Looks {
  readonly #objects: GpuObjects;
  readonly #view: UniformMap;
  #shown: Look | undefined;
  #coming: Look | undefined;

  /** @param view uniforms that the drawing side itself fills */
  constructor(objects: GpuObjects, view: UniformMap) {
    this.#objects = objects;
    this.#view = view;
  }

  /** What is drawn. */
  get shown(): Look | undefined {
    return this.#shown;
  }

  /** What is being prepared. */
  get coming(): Look | undefined {
    return this.#coming;
  }

  /** The look of a set of effects: the one that is drawn, or one that is being prepared from now on. */
  want(plan: EffectPlan): Look {
    if (this.#shown?.plan.key === plan.key) {
      this.#coming?.destroy();
      this.#coming = undefined;
      return this.#shown;
    }
    if (this.#coming?.plan.key !== plan.key) {
      this.#coming?.destroy();
      this.#coming = new Look(this.#objects, plan, this.#view);
    }
    return this.#coming;
  }

  /** What was being prepared is drawn from now on. */
  change(): void {
    if (!this.#coming) return;
    this.#shown?.destroy();
    this.#shown = this.#coming;
    this.#coming = undefined;
  }

  destroy(): void {
    this.#shown?.destroy();
    this.#coming?.destroy();
  }
}
