import { BlendEquation, BlendFunction, BlendingState, DepthFunction } from "cesium";
import type { PointPass } from "../../effects/index.js";
import { RenderState, type RenderStateOptions } from "./cesium-private.js";

const NEAREST_WINS: RenderStateOptions = {
  depthTest: { enabled: true, func: DepthFunction.LESS_OR_EQUAL },
};

const { ADD } = BlendEquation;
const { ONE } = BlendFunction;

/** What is drawn: into the scene, or in a pass of the layer's own. */
type DrawingKind = "opaque" | "translucent" | PointPass;

/** How colour and depth are treated. */
const STATES: Readonly<Record<DrawingKind, RenderStateOptions>> = {
  opaque: NEAREST_WINS,
  translucent: {
    ...NEAREST_WINS,
    depthMask: false,
    blending: BlendingState.ALPHA_BLEND as { enabled: boolean },
  },
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

/** Render states, which Cesium shares between all that draw alike. */
export class RenderStates {
  readonly #states = new Map<DrawingKind, RenderState>();

  of(kind: DrawingKind): RenderState {
    let state = this.#states.get(kind);
    if (!state) {
      state = RenderState.fromCache(STATES[kind]);
      this.#states.set(kind, state);
    }
    return state;
  }

  /** Gives the shared states back. */
  destroy(): void {
    for (const state of this.#states.values()) RenderState.removeFromCache(state);
    this.#states.clear();
  }
}
