import { bytesPerPoint } from "../drawing/drawn-node.js";
import type { GpuMilliseconds, LayerFrames } from "../drawing/frame.js";
import { type GpuCounts, NO_OBJECTS } from "../drawing/gpu.js";
import type { LayerRenderer } from "./layer-renderer.js";
import type { CesiumView } from "./node-drawable.js";

/** Numbers about the frame drawn last. */
export interface LayerStatistics {
  /** Nodes with points that the view wants. */
  readonly nodesVisible: number;
  /** Of these, drawn. */
  readonly nodesLoaded: number;
  /** Of these, failed; hierarchy pages that cannot be read count as well. Never counted as loaded. */
  readonly nodesFailed: number;
  readonly pointsDrawn: number;
  /** True where the point budget, not the screen-space error, ended the refinement. */
  readonly budgetReached: boolean;
  /** Nodes and pages being loaded. */
  readonly requestsPending: number;
  /** Bytes of buffers and textures on the GPU. */
  readonly gpuBytes: number;
  /** Bytes of vertices that a point takes there: positions 8, or 12 where the tolerance asks for it, and colours 4. */
  readonly bytesPerPoint: number;
  /** GPU objects alive, by kind; all 0 after `destroy()`. */
  readonly gpuObjects: GpuCounts;
  /** GPU milliseconds of the points and of the pass over the picture; undefined where the browser does not say. */
  readonly gpuMilliseconds: GpuMilliseconds;
}

/**
 * @param renderer undefined where nothing is on the GPU
 * @param requestsPending nodes and pages being loaded
 */
export function statisticsOf(
  { progress, limited }: Pick<LayerFrames<CesiumView>, "progress" | "limited">,
  renderer: LayerRenderer | undefined,
  requestsPending: number,
): LayerStatistics {
  const nodes = renderer?.content.nodes ?? [];
  return {
    nodesVisible: progress.wanted,
    nodesLoaded: nodes.length,
    nodesFailed: progress.failed,
    pointsDrawn: nodes.reduce((sum, { count }) => sum + count, 0),
    budgetReached: limited,
    requestsPending,
    gpuBytes: renderer?.objects.bytes ?? 0,
    bytesPerPoint: bytesPerPoint(nodes),
    gpuObjects: renderer?.objects.counts ?? NO_OBJECTS,
    gpuMilliseconds: renderer?.gpuMilliseconds ?? { points: undefined, picture: undefined },
  };
}
