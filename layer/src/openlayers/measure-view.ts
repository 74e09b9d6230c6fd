import DoubleClickZoom from "ol/interaction/DoubleClickZoom.js";
import type OlMap from "ol/Map.js";
import { unByKey } from "ol/Observable.js";
import { fromLonLat } from "ol/proj.js";
import { recordVertex, type Vertex, type ViewAdapter } from "../tools/index.js";
import type { PointCloudLayer } from "./point-cloud-layer.js";

const DEGREE = Math.PI / 180;

/**
 * A map of OpenLayers for a `MeasureTool`: picks records of layers, and shows vertices at their places on the map.
 * @param layers those that are measured, asked for anew each time
 */
export function measureView(map: OlMap, layers: () => readonly PointCloudLayer[]): ViewAdapter {
  /** Interactions that rest while a figure is drawn. */
  let resting: DoubleClickZoom[] = [];
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
    project({ longitude, latitude }) {
      const lonLat = [longitude / DEGREE, latitude / DEGREE];
      const pixel = map.getPixelFromCoordinate(fromLonLat(lonLat, map.getView().getProjection()));
      const [x, y] = pixel ?? [];
      return Number.isFinite(x) && Number.isFinite(y) ? { x, y } : undefined;
    },
    onFrame(listener) {
      const key = map.on("postrender", listener);
      return () => unByKey(key);
    },
    redraw: () => map.render(),
    drawing(active) {
      for (const one of resting) one.setActive(true);
      const zooms = map.getInteractions().getArray();
      resting = zooms
        .filter((one) => one instanceof DoubleClickZoom)
        .filter((one) => active && one.getActive());
      for (const one of resting) one.setActive(false);
    },
  };
}
