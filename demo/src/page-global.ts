import type { PointCloudLayer } from "@groma/layer/cesium";
import type { PointNavigation } from "@groma/layer/navigation";
import type { MeasureTool } from "@groma/layer/tools";
import type { Viewer } from "cesium";
import type { Clouds } from "./clouds/clouds.js";
import type { Beside } from "./map/beside.js";
import type { ProfilePanel } from "./profile/profile-panel.js";

/** What the page offers to the browser's console and to tests. */
export interface Groma {
  readonly viewer: Viewer;
  /** What moves the globe's camera. */
  readonly navigation: PointNavigation;
  readonly clouds: Clouds;
  readonly measure: MeasureTool;
  /** The map beside the globe. */
  readonly beside: Beside;
  readonly profile: ProfilePanel;
  /** The cloud, from when the camera stands before it. */
  layer: PointCloudLayer | undefined;
}

declare global {
  interface Window {
    groma?: Groma;
  }
}
