import type { PointCloudLayer } from "@groma/layer/cesium";
import type { MeasureTool } from "@groma/layer/tools";
import type { Viewer } from "cesium";

/** What the page offers to the browser's console and to tests. */
export interface Groma {
  readonly viewer: Viewer;
  readonly measure: MeasureTool;
  /** The cloud, from when the camera stands before it. */
  layer: PointCloudLayer | undefined;
}

declare global {
  interface Window {
    groma?: Groma;
  }
}
