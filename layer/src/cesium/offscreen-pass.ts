import { BlendEquation, BlendFunction, Color, DepthFunction } from "cesium";
import type { PointPass } from "../effects/index.js";
import type { DrawnNode } from "./drawn-node.js";
import {
  ClearCommand,
  type Context,
  type PassState,
  RenderState,
  type RenderStateOptions,
} from "./engine/cesium-private.js";
import type { PointFrustum } from "./point-frustum.js";
import type { PointProgram } from "./point-programs.js";

/** What a pass over the points needs besides the points. */
export interface PassSetting {
  readonly context: Context;
  readonly target: PassState;
  readonly frustum: PointFrustum;
  readonly owner: object;
  readonly programOf: (node: DrawnNode) => PointProgram;
}

const NEAREST_WINS: RenderStateOptions = {
  depthTest: { enabled: true, func: DepthFunction.LESS_OR_EQUAL },
};

const { ADD } = BlendEquation;
const { ONE } = BlendFunction;

/** How the passes treat colour and depth. */
const STATES: Readonly<Record<PointPass, RenderStateOptions>> = {
  color: NEAREST_WINS,
  id: NEAREST_WINS,
  depth: { ...NEAREST_WINS, colorMask: { red: false, green: false, blue: false, alpha: false } },
  // What lies within the blend depth of the nearest adds up.
  splat: {
    ...NEAREST_WINS,
    depthMask: false,
    blending: {
      enabled: true,
      equationRgb: ADD,
      equationAlpha: ADD,
      functionSourceRgb: ONE,
      functionSourceAlpha: ONE,
      functionDestinationRgb: ONE,
      functionDestinationAlpha: ONE,
    },
  },
};

/** Passes over the points into pictures of the layer's own, executed at once and not through Cesium's list. */
export class OffscreenPass {
  readonly #states = new Map<PointPass, RenderState>();

  /** Clears a picture: colours to nothing and, unless they are to stay, depths to the farthest. */
  clear(context: Context, target: PassState, depth: boolean): void {
    const color = new Color(0, 0, 0, 0);
    new ClearCommand(depth ? { color, depth: 1 } : { color }).execute(context, target);
  }

  /** Draws nodes. */
  draw(pass: PointPass, nodes: Iterable<DrawnNode>, setting: PassSetting): void {
    const { context, target, frustum, owner, programOf } = setting;
    const renderState = this.#state(pass);
    context.uniformState.updateFrustum(frustum.frustum);
    for (const node of nodes) {
      const { drawable, uniforms, count } = node;
      const dress = { owner, program: programOf(node), renderState, uniformMap: uniforms.map, pass: 0 };
      drawable.ownCommand(dress, count).execute(context, target);
    }
  }

  /** Gives the shared states back. */
  destroy(): void {
    for (const state of this.#states.values()) RenderState.removeFromCache(state);
    this.#states.clear();
  }

  #state(pass: PointPass): RenderState {
    let state = this.#states.get(pass);
    if (!state) {
      state = RenderState.fromCache(STATES[pass]);
      this.#states.set(pass, state);
    }
    return state;
  }
}
