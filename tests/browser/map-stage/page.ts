import * as layer from "@groma/layer/openlayers";
import { MapStage } from "./map-stage.js";
import * as ol from "./ol.js";

declare global {
  interface Window {
    /** What tests of maps work with in the page. */
    map: {
      readonly ol: typeof ol;
      readonly layer: typeof layer;
      readonly MapStage: typeof MapStage;
      /** The stage that stands, if any. */
      stage: MapStage;
    };
  }
}

window.map = { ol, layer, MapStage, stage: undefined as unknown as MapStage };
document.body.dataset.ready = "true";
