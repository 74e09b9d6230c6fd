import { Color } from "cesium";
import type { GroupedNodes } from "../drawing/drawn-node.js";
import type { Program } from "../drawing/programs.js";
import type { EffectPlan, PointPass } from "../effects/index.js";
import { ClearCommand, type Context, type PassState } from "./engine/cesium-private.js";
import type { CesiumTypes, GpuObjects } from "./engine/gpu-objects.js";
import type { RenderStates } from "./engine/render-states.js";
import type { CesiumView } from "./node-drawable.js";
import { PointBatch } from "./point-batch.js";
import type { PointFrustum } from "./point-frustum.js";

/** What a pass over the points needs besides the points. */
export interface PassSetting {
  readonly objects: GpuObjects;
  readonly target: PassState;
  readonly frustum: PointFrustum;
  readonly owner: object;
  readonly programOf: (plan: EffectPlan) => Program<CesiumTypes>;
}

/** Passes over the points into pictures of the layer's own, executed at once and not through Cesium's list. */
export class OffscreenPass {
  readonly #states: RenderStates;
  #batch: PointBatch | undefined;

  constructor(states: RenderStates) {
    this.#states = states;
  }

  /** Clears a picture: colours to nothing, depths to the farthest. */
  clear(context: Context, target: PassState): void {
    new ClearCommand({ color: new Color(0, 0, 0, 0), depth: 1 }).execute(context, target);
  }

  /** Draws nodes, whose groups have been placed. */
  draw(pass: PointPass, nodes: GroupedNodes<CesiumView>, setting: PassSetting): void {
    const { objects, target, frustum, owner, programOf } = setting;
    const { context } = objects;
    const renderState = this.#states.of(pass);
    context.uniformState.updateFrustum(frustum.frustum);
    this.#batch ??= new PointBatch(objects);
    for (const [{ plan, uniforms }, members] of nodes) {
      const state = { owner, program: programOf(plan), renderState, uniformMap: uniforms.map, pass: 0 };
      this.#batch.command(members, state).execute(context, target);
    }
  }
}
