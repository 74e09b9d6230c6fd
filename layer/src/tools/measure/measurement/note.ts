import { CAMERA_VIEW, type CameraView } from "../../../camera/index.js";
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
  // Own names: those of the list above.
  const numbers = CAMERA_VIEW.map((name) => [name, saved[name]] as const);
  if (!numbers.every(([, value]) => Number.isFinite(value))) return undefined;
  return Object.fromEntries(numbers) as unknown as CameraView;
}
