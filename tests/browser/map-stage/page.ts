import * as exporting from "@groma/layer/export";
import * as layer from "@groma/layer/openlayers";
import * as tools from "@groma/layer/tools";
import { onPoints } from "../stage/point-calls.js";
import { MapStage } from "./map-stage.js";
import * as ol from "./ol.js";
import { lineThrough, PlotStage } from "./plot-stage.js";

declare global {
  interface Window {
    /** What tests of maps work with in the page. */
    map: {
      readonly ol: typeof ol;
      readonly layer: typeof layer;
      readonly tools: typeof tools;
      readonly exporting: typeof exporting;
      readonly MapStage: typeof MapStage;
      readonly PlotStage: typeof PlotStage;
      readonly lineThrough: typeof lineThrough;
      readonly onPoints: typeof onPoints;
      /** The plot of its cloud, if any. */
      plot: PlotStage;
      /** The stage that stands, if any. */
      stage: MapStage;
      /** The tool that measures on it, if any. */
      measure: tools.MeasureTool;
    };
  }
}

window.map = {
  ...{ ol, layer, tools, exporting, MapStage, PlotStage, lineThrough, onPoints },
  plot: undefined as unknown as PlotStage,
  stage: undefined as unknown as MapStage,
  measure: undefined as unknown as tools.MeasureTool,
};
document.body.dataset.ready = "true";
