import type { PointCloudLayer } from "@groma/layer/cesium";
import type { Scene } from "cesium";

/**
 * Has a scene that draws on demand (`requestRenderMode`) draw what changes of its layers. Cesium sees by itself that the
 * camera moves, but for the least of moves, or that a tile of the globe has come, and layers ask for frames while they load;
 * of their options neither tells.
 * @param frames how many are drawn after a change, and when this number itself changes
 */
export function drawChanges(
  scene: Pick<Scene, "preUpdate" | "requestRender">,
  layers: () => readonly PointCloudLayer[],
  frames: () => number,
): void {
  let before: readonly unknown[] = [];
  let left = 0;
  // Raised for each frame of the page, also where none of the scene is drawn.
  scene.preUpdate.addEventListener(() => {
    const count = frames();
    const now = [count, ...layers().flatMap(optionsOf)];
    const same = now.length === before.length && now.every((value, at) => value === before[at]);
    before = now;
    if (!same) left = count;
    if (left <= 0 && layers().every(({ settled }) => settled)) return;
    left--;
    scene.requestRender();
  });
}

/** What a frame shows of a layer, in a form that can be compared. */
function optionsOf(layer: PointCloudLayer): readonly unknown[] {
  const { show, style, filter, forced, clips, budget, pointBudget, maximumScreenSpaceError, heightOffset } =
    layer;
  return [
    ...[layer, show, style, filter, forced, clips, clips.revision],
    ...[budget, pointBudget, maximumScreenSpaceError, heightOffset],
  ];
}
