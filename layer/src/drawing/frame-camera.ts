import type { View } from "../octree/index.js";
import type { LogarithmicDepth } from "./program-needs.js";

/** The camera of a frame, and what it draws into. */
export interface FrameCamera {
  /** Where it stands among the points' places: moved the other way where points are drawn above them. */
  readonly view: View;
  /** Width of the picture in pixels. */
  readonly width: number;
  /** Pixels per CSS pixel. */
  readonly pixelRatio: number;
  /** Distance of the near plane, metres. */
  readonly near: number;
  /** Where depth is logarithmic. */
  readonly depth: LogarithmicDepth;
  /** Where the camera is and looks at the time of asking, in a form that can be compared. */
  readonly pose: () => readonly number[];
}
