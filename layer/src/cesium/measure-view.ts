import type { Vector } from "@groma/georef";
import { Cartesian3, type Scene } from "cesium";
import { liftOf } from "../drawing/height-offset.js";
import type { ScreenPoint, Vertex, ViewAdapter } from "../tools/index.js";
import { recordVertex } from "../tools/measure/vertex/vertex.js";
import type { PointCloudLayer } from "./point-cloud-layer.js";

/**
 * A scene of Cesium for a `MeasureTool`: picks records of layers, and shows vertices where their points are drawn.
 * @param layers those that are measured, asked for anew each time
 */
export function measureView(scene: Scene, layers: () => readonly PointCloudLayer[]): ViewAdapter {
  const place = new Cartesian3();
  return {
    element: scene.canvas,
    async pick(at, reach, signal) {
      const window = 2 * reach + 1;
      const hits = await Promise.all(layers().map((layer) => layer.pick(at, { window, signal })));
      const eye = Cartesian3.clone(scene.camera.positionWC);
      let nearest: Vertex | undefined;
      let least = Number.POSITIVE_INFINITY;
      for (const hit of hits) {
        if (!hit) continue;
        const away = Cartesian3.distance(eye, hit.position);
        if (away < least) [nearest, least] = [recordVertex(hit.cloud, hit), away];
      }
      return nearest;
    },
    project(vertex) {
      const [x, y, z] = drawnPlace(vertex, layers());
      const found = scene.cartesianToCanvasCoordinates(Cartesian3.fromElements(x, y, z, place));
      return found && behindHorizon(scene, place) ? undefined : screenPoint(found);
    },
    onFrame: (listener) => scene.postRender.addEventListener(listener),
    redraw: () => scene.requestRender(),
    covering: () => Array.from(scene.canvas.closest(".cesium-viewer")?.querySelectorAll(OWN) ?? []),
  };
}

/** What a `Viewer` of Cesium puts over its scene. */
const OWN = [
  ...[
    "toolbar",
    "animationContainer",
    "timelineContainer",
    "fullscreenContainer",
    "vrContainer",
    "infoBoxContainer",
  ],
]
  .map((name) => `.cesium-viewer-${name}`)
  .concat(
    ".cesium-credit-logoContainer",
    ".cesium-credit-textContainer",
    ".cesium-performanceDisplay-defaultContainer",
  )
  .join();

function screenPoint(found: { x: number; y: number } | undefined): ScreenPoint | undefined {
  return found && Number.isFinite(found.x) && Number.isFinite(found.y)
    ? { x: found.x, y: found.y }
    : undefined;
}

/** Where a layer draws a vertex: lifted with the others of its data set. */
function drawnPlace({ ecef, cloud }: Vertex, layers: readonly PointCloudLayer[]): Vector {
  const layer = layers.find((one) => one.cloud === cloud);
  if (!layer || layer.heightOffset === 0) return ecef;
  const [x, y, z] = liftOf(layer.cloud.bounds, layer.heightOffset);
  return [ecef[0] + x, ecef[1] + y, ecef[2] + z];
}

/** Whether the earth lies between the camera and a place: only where both are well outside of the other's sight. */
function behindHorizon({ camera, globe }: Scene, place: Cartesian3): boolean {
  if (!globe?.show) return false;
  const { minimumRadius } = globe.ellipsoid;
  const eye = camera.positionWC;
  // A sphere below the ellipsoid and all that is dug into it: what it hides is hidden.
  const radius = minimumRadius - 20_000;
  const way = Cartesian3.subtract(place, eye, new Cartesian3());
  const square = Cartesian3.magnitudeSquared(way);
  const along = square > 0 ? -Cartesian3.dot(eye, way) / square : 0;
  if (along <= 0 || along >= 1) return false;
  const nearest = Cartesian3.add(eye, Cartesian3.multiplyByScalar(way, along, way), way);
  return Cartesian3.magnitude(nearest) < radius;
}
