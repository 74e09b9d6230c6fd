import type { PointCloud } from "@groma/layer";

/** How far the stream of a cloud has come. */
type Progress = ReturnType<PointCloud["stream"]["progress"]>;

/** What a view of a cloud went through. */
export interface Watched {
  /** Progress as often as it changed. */
  readonly seen: readonly Progress[];
  /** Nodes that failed, with the codes of their errors. */
  readonly failed: readonly string[];
  /** Frames until the condition holds. @throws after ten seconds */
  until(condition: (progress: Progress) => boolean): Promise<Progress>;
  /** Ends the view. */
  end(): void;
}

/** Milliseconds between two frames. */
const FRAME = 4;

/**
 * A view of the whole cloud in full, frame by frame. Each frame is held against what is there: progress that counts as
 * complete while something wanted is missing ends the test.
 */
export function watch(cloud: PointCloud): Watched {
  const { x, y, z } = cloud.bounds;
  const radius = Math.hypot(x, y, z);
  const up = [x / radius, y / radius, z / radius];
  const view = {
    position: [x + 500 * up[0], y + 500 * up[1], z + 500 * up[2]] as const,
    direction: [-up[0], -up[1], -up[2]] as const,
    planes: [],
    height: 1000,
    projection: { kind: "perspective", fieldOfView: 1 } as const,
    horizon: false,
  };
  const { stream } = cloud;
  const viewer = {};
  const seen: Progress[] = [];
  const failed: string[] = [];
  const unsubscribe = stream.subscribe({
    nodeFailed: (_node, error) => failed.push("code" in error ? String(error.code) : error.message),
  });
  const frame = (): Progress => {
    const { nodes, pages } = stream.update(viewer, view, {
      maximumScreenSpaceError: 0.001,
      pointBudget: 1e9,
    });
    const progress = stream.progress(viewer);
    if (progress.pending === 0 && progress.failed === 0) {
      const missing = nodes.filter((node) => !stream.vertices(node)).length + pages.length;
      if (missing > 0 || nodes.length === 0) throw new Error(`complete, but ${missing} are missing`);
    }
    const before = seen.at(-1);
    if (JSON.stringify(before) !== JSON.stringify(progress)) seen.push(progress);
    return progress;
  };
  return {
    seen,
    failed,
    async until(condition) {
      const end = performance.now() + 10_000;
      for (;;) {
        const progress = frame();
        if (condition(progress)) return progress;
        if (performance.now() > end) throw new Error(`still ${JSON.stringify(progress)}`);
        await new Promise((done) => setTimeout(done, FRAME));
      }
    },
    end() {
      unsubscribe();
      stream.detach(viewer);
    },
  };
}

/** Whether all that a view wants is here. */
export const isComplete = ({ pending, failed }: Progress): boolean => pending === 0 && failed === 0;
