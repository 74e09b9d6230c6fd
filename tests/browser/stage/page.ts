import * as layer from "@groma/layer/cesium";
import { PointNavigation } from "@groma/layer/navigation";
import * as Cesium from "cesium";
import { onPoints } from "./point-calls.js";
import { Stage } from "./stage.js";

declare global {
  interface Window {
    /** What tests work with in the page. */
    page: {
      readonly Cesium: typeof Cesium;
      readonly layer: typeof layer;
      readonly Stage: typeof Stage;
      readonly PointNavigation: typeof PointNavigation;
      readonly onPoints: typeof onPoints;
      /** The stage that stands, if any. */
      stage: Stage;
      /** What moves its camera, if anything. */
      navigation: PointNavigation;
    };
  }
}

window.page = { Cesium, layer, Stage, PointNavigation, onPoints } as Window["page"];
document.body.dataset.ready = "true";
