import * as layer from "@groma/layer/cesium";
import * as Cesium from "cesium";
import { Stage } from "./stage.js";

declare global {
  interface Window {
    /** What tests work with in the page. */
    page: {
      readonly Cesium: typeof Cesium;
      readonly layer: typeof layer;
      readonly Stage: typeof Stage;
      /** The stage that stands, if any. */
      stage: Stage;
    };
  }
}

window.page = { Cesium, layer, Stage, stage: undefined as unknown as Stage };
document.body.dataset.ready = "true";
