import { bytesPerPoint, type DrawnNode } from "./drawn-node.js";
import { type GpuCounts, NO_OBJECTS } from "./gpu.js";

/** Numbers about the frame drawn last, whatever view draws it. */
export interface DrawnStatistics {
  /** Nodes with points that the view wants. */
  readonly nodesVisible: number;
  /** Of these, drawn. */
  readonly nodesLoaded: number;
  /** Of these, failed; hierarchy pages that cannot be read count as well. Never counted as loaded. */
  readonly nodesFailed: number;
  readonly pointsDrawn: number;
  /** True where the point budget, not the screen-space error, ended the refinement. */
  readonly budgetReached: boolean;
  /** Bytes of buffers and textures on the GPU. */
  readonly gpuBytes: number;
  /** Bytes of vertices that a point takes there: positions 8, or 12 where the tolerance asks for it, and colours 4. */
  readonly bytesPerPoint: number;
  /** GPU objects alive, by kind; all 0 once the layer is destroyed. */
  readonly gpuObjects: GpuCounts;
}

/** What the numbers are of a layer's frames. */
interface CountedFrames {
  readonly progress: { readonly wanted: number; readonly failed: number };
  readonly limited: boolean;
}

/** What they are of what is on the GPU. */
interface CountedRenderer {
  readonly content: { readonly nodes: readonly DrawnNode[] };
  readonly objects: { readonly bytes: number; readonly counts: GpuCounts };
}

/**
 * @param frames undefined where none was drawn
 * @param renderer undefined where nothing is on the GPU
 */
export function drawnStatistics(
  frames: CountedFrames | undefined,
  renderer: CountedRenderer | undefined,
): DrawnStatistics {
  const { wanted = 0, failed = 0 } = frames?.progress ?? {};
  const nodes = renderer?.content.nodes ?? [];
  return {
    ...{ nodesVisible: wanted, nodesLoaded: nodes.length, nodesFailed: failed },
    pointsDrawn: nodes.reduce((sum, { count }) => sum + count, 0),
    budgetReached: frames?.limited ?? false,
    gpuBytes: renderer?.objects.bytes ?? 0,
    bytesPerPoint: bytesPerPoint(nodes),
    gpuObjects: renderer?.objects.counts ?? NO_OBJECTS,
  };
}
