import { BlendingState, DepthFunction } from "cesium";
import { RenderState } from "./engine/cesium-private.js";

/** How what goes into the scene treats colour and depth. */
export class SceneStates {
  readonly opaque = RenderState.fromCache({
    depthTest: { enabled: true, func: DepthFunction.LESS_OR_EQUAL },
  });
  readonly translucent = RenderState.fromCache({
    depthTest: { enabled: true, func: DepthFunction.LESS_OR_EQUAL },
    depthMask: false,
    blending: BlendingState.ALPHA_BLEND as { enabled: boolean },
  });

  /** Gives the shared states back. */
  destroy(): void {
    RenderState.removeFromCache(this.opaque);
    RenderState.removeFromCache(this.translucent);
  }
}
