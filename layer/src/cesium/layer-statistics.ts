import { type DrawnStatistics, drawnStatistics } from "../drawing/drawn-statistics.js";
import type { GpuMilliseconds, LayerFrames } from "../drawing/frame.js";
import type { LayerRenderer } from "./layer-renderer.js";
import type { CesiumView } from "./node-drawable.js";

/** Numbers about the frame drawn last. */
export interface LayerStatistics extends DrawnStatistics {
  /** Nodes and pages being loaded. */
  readonly requestsPending: number;
  /** GPU milliseconds of the points and of the pass over the picture; undefined where the browser does not say. */
  readonly gpuMilliseconds: GpuMilliseconds;
}

/**
 * @param renderer undefined where nothing is on the GPU
 * @param requestsPending nodes and pages being loaded
 */
export function statisticsOf(
  frames: Pick<LayerFrames<CesiumView>, "progress" | "limited">,
  renderer: LayerRenderer | undefined,
  requestsPending: number,
): LayerStatistics {
  return {
    ...drawnStatistics(frames, renderer),
    requestsPending,
    gpuMilliseconds: renderer?.gpuMilliseconds ?? { points: undefined, picture: undefined },
  };
}
