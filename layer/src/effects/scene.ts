import type { SceneFacts } from "./facts.js";
import type { PointCloudStyle } from "./style.js";

/** A style and the frame that it is drawn in. */
export interface Scene {
  readonly style: PointCloudStyle;
  readonly facts: SceneFacts;
}
