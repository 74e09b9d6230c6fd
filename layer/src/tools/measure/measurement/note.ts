import { type CameraView, isCameraView } from "../../../camera/index.js";
import { isObject } from "./volume-settings.js";

/** What an annotation says. */
export interface Note {
  /** Plain text: never to be read as markup. */
  readonly text: string;
  /** From where it was written: as `cameraView` has it. */
  readonly camera?: CameraView | undefined;
}

/** Characters of a text at most. */
const LONGEST = 20_000;

/** A note as it stands in a file; undefined where it is none. A camera that is none is left out. */
export function noteOf(saved: unknown): Note | undefined {
  if (!isObject(saved) || typeof saved.text !== "string" || saved.text.length > LONGEST) return undefined;
  const camera = cameraOf(saved.camera);
  return { text: saved.text, ...(camera && { camera }) };
}

function cameraOf(saved: unknown): CameraView | undefined {
  if (!isObject(saved)) return undefined;
  const { longitude, latitude, height, heading, pitch, roll } = saved;
  const camera = { longitude, latitude, height, heading, pitch, roll };
  return isCameraView(camera) ? camera : undefined;
}
