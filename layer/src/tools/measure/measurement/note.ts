import { isObject } from "./volume-settings.js";

/** From where a note was written: the camera of a globe, as `cameraView` has it. Angles are radians. */
export interface NoteCamera {
  /** Of WGS 84. */
  readonly longitude: number;
  readonly latitude: number;
  /** Above the ellipsoid, metres. */
  readonly height: number;
  /** Clockwise from north. */
  readonly heading: number;
  /** Above the horizon. */
  readonly pitch: number;
  readonly roll: number;
}

/** What an annotation says. */
export interface Note {
  /** Plain text: never to be read as markup. */
  readonly text: string;
  readonly camera?: NoteCamera | undefined;
}

/** Characters of a text at most. */
const LONGEST = 20_000;

const CAMERA = ["longitude", "latitude", "height", "heading", "pitch", "roll"] as const;

/** A note as it stands in a file; undefined where it is none. A camera that is none is left out. */
export function noteOf(saved: unknown): Note | undefined {
  if (!isObject(saved) || typeof saved.text !== "string" || saved.text.length > LONGEST) return undefined;
  const camera = cameraOf(saved.camera);
  return { text: saved.text, ...(camera && { camera }) };
}

function cameraOf(saved: unknown): NoteCamera | undefined {
  if (!isObject(saved)) return undefined;
  // Own names: those of the list above.
  const numbers = CAMERA.map((name) => [name, saved[name]] as const);
  if (!numbers.every(([, value]) => Number.isFinite(value))) return undefined;
  return Object.fromEntries(numbers) as unknown as NoteCamera;
}
