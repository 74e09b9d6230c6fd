import * as layer from "@groma/layer/cesium";
import { PointNavigation } from "@groma/layer/navigation";
import * as Cesium from "cesium";
import { Stage } from "./stage.js";

declare global {
  interface Window {
    /** What tests work with in the page. */
    page: {
      readonly Cesium: typeof Cesium;
      readonly layer: typeof layer;
      readonly Stage: typeof Stage;
      readonly PointNavigation: typeof PointNavigation;
      /** The stage that stands, if any. */
      stage: Stage;
      /** What moves its camera, if anything. */
      navigation: PointNavigation;
    };
  }
}

window.page = { Cesium, layer, Stage, PointNavigation } as Window["page"];
document.body.dataset.ready = "true";
