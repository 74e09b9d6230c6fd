import DoubleClickZoom from "ol/interaction/DoubleClickZoom.js";
import type OlMap from "ol/Map.js";
import { unByKey } from "ol/Observable.js";
import { fromLonLat } from "ol/proj.js";
import type { Vertex, ViewAdapter } from "../tools/index.js";
import { recordVertex } from "../tools/measure/vertex/vertex.js";
import type { PointCloudLayer } from "./point-cloud-layer.js";

const DEGREE = Math.PI / 180;

/** Milliseconds after the click that ends a figure in which OpenLayers (250 ms) may still take it for half of a double click. */
const DOUBLE_CLICK = 300;

/**
 * A map of OpenLayers for a `MeasureTool`: picks records of layers, and shows vertices at their places on the map.
 * @param layers those that are measured, asked for anew each time
 */
export function measureView(map: OlMap, layers: () => readonly PointCloudLayer[]): ViewAdapter {
  /** Interactions that rest while a figure is drawn. */
  const resting: DoubleClickZoom[] = [];
  let waking: ReturnType<typeof setTimeout> | undefined;
  return {
    element: map.getViewport(),
    async pick({ x, y }, reach, signal) {
      const window = 2 * reach + 1;
      const hits = await Promise.all(layers().map((layer) => layer.pick([x, y], { window, signal })));
      // Seen from above, the highest of several layers is in front.
      let highest: Vertex | undefined;
      for (const hit of hits) {
        const vertex = hit && recordVertex(hit.cloud, hit);
        if (vertex && vertex.height > (highest?.height ?? Number.NEGATIVE_INFINITY)) highest = vertex;
      }
      return highest;
    },
    project({ longitude, latitude }, near) {
      const view = map.getView();
      const projection = view.getProjection();
      const at = fromLonLat([longitude / DEGREE, latitude / DEGREE], projection);
      const world = projection.canWrapX() ? projection.getExtent() : undefined;
      const about = near ? map.getCoordinateFromPixel([near.x, near.y]) : view.getCenter();
      if (world && about) {
        const width = world[2] - world[0];
        at[0] += width * Math.round((about[0] - at[0]) / width);
      }
      const [x, y] = map.getPixelFromCoordinate(at) ?? [];
      return Number.isFinite(x) && Number.isFinite(y) ? { x, y } : undefined;
    },
    onFrame(listener) {
      const key = map.on("postrender", listener);
      return () => unByKey(key);
    },
    redraw: () => map.render(),
    covering: () => Array.from(map.getViewport().querySelectorAll(".ol-control")),
    drawing(active) {
      clearTimeout(waking);
      if (!active) {
        waking = setTimeout(() => {
          for (const one of resting.splice(0)) one.setActive(true);
        }, DOUBLE_CLICK);
        return;
      }
      for (const one of map.getInteractions().getArray()) {
        if (!(one instanceof DoubleClickZoom) || !one.getActive()) continue;
        one.setActive(false);
        resting.push(one);
      }
    },
  };
}
