import { onPoints } from "../browser/stage/point-calls.js";
import type { Stage } from "../browser/stage/stage.js";

/**
 * Loads and uploads all that a stage wants. Points are not drawn meanwhile, which would take most of the time in software.
 * @param longest milliseconds
 */
export async function settle(stage: Stage, longest: number): Promise<void> {
  const end = onPoints(stage.gl, () => {});
  try {
    await stage.settle([stage.layer], longest);
  } finally {
    end();
  }
  // A picture without points may be kept: the next frame draws, since it has another style, though an equal one.
  stage.layer.style = {};
}
