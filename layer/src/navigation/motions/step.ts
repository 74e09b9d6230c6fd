import { cross } from "@groma/georef";
import { type CameraPose, heightOf, upAt } from "../../camera/index.js";
import { beside, levelRight, turned, turnOnto } from "./turning.js";

/** How far a camera goes, metres: in its horizontal direction, to its right and upwards. */
export interface Step {
  readonly ahead: number;
  readonly aside: number;
  readonly up: number;
}

/** A camera that has walked: over the earth at its height, and up; it keeps its tilt, and turns nowhere, poles included. */
export function step(pose: CameraPose, { ahead, aside, up }: Step): CameraPose {
  const { position } = pose;
  const vertical = upAt(position);
  const right = levelRight(pose, vertical);
  const there = beside(beside(position, ahead, cross(vertical, right)), aside, right);
  const height = heightOf(position) + up;
  const moved = beside(there, height - heightOf(there), upAt(there));
  return turned(pose, turnOnto(vertical, upAt(moved)), moved);
}
