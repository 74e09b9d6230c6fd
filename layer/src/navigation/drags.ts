import { dot, type Vector } from "@groma/georef";
import { type CameraPose, type ScreenPlace, upAt } from "../camera/index.js";
import { orbit, type PanWay, panTo, panWay } from "./motions/index.js";
import type { Mover } from "./mover.js";
import type { NavigationMode, NavigationSettings } from "./options.js";
import type { Drag } from "./pointers.js";

/** What a drag does: `hands` is two fingers, which move, zoom and turn at once. */
export type DragWay = "pan" | "orbit" | "look" | "hands";

/** A drag, and how much of it has been done. */
export interface Held {
  readonly drag: Drag;
  readonly way: DragWay;
  /** What it is about, ECEF; undefined while that is looked for. */
  place: Vector | undefined;
  pan: PanWay | undefined;
  done: { at: ScreenPlace; spread: number; angle: number };
  /** Whether the pointers were let go, so that it ends with what has been dragged. */
  over: boolean;
}

/** A drag that begins. */
export function heldBy(drag: Drag, mode: NavigationMode, left: NavigationSettings["drag"]): Held {
  const { start, spread, angle } = drag;
  return {
    drag,
    way: wayOf(drag, mode, left),
    place: undefined,
    over: false,
    pan: undefined,
    done: { at: start, spread, angle },
  };
}

function wayOf(
  { pointers, number, shift, control }: Drag,
  mode: NavigationMode,
  left: "pan" | "orbit",
): DragWay {
  if (pointers === "touch" && number > 1) return number === 2 ? "hands" : "orbit";
  const first = pointers === "touch" || number === 0;
  if (shift) return "look";
  if (mode === "walk") return first && !control ? "look" : "pan";
  const other = left === "pan" ? "orbit" : "pan";
  return first && !control ? left : other;
}

/** The camera as a drag moves it, by what it has gone since it was looked at last. */
export function dragOn(pose: CameraPose, held: Held, mover: Mover): CameraPose {
  const { drag, way, done, place } = held;
  if (way !== "look" && !place) return pose;
  const { at, spread, angle } = drag;
  const [dx, dy] = [at.x - done.at.x, at.y - done.at.y];
  held.done = { at, spread, angle };
  const { height, halves } = mover.lens;
  if (way === "orbit" && place) {
    const perPixel = Math.PI / height;
    return orbit(pose, place, -perPixel * dx, -perPixel * dy, mover.pitches(place, pose));
  }
  if (way === "look" || !place) {
    // A pixel of the middle of the picture; without perspective, of one that is a radian high.
    const perPixel = (halves.parallel ? 1 : 2 * Math.atan(halves.up)) / height;
    return orbit(pose, pose.position, perPixel * dx, perPixel * dy);
  }
  if (dx === 0 && dy === 0 && spread === done.spread && angle === done.angle) return pose;
  held.pan ??= panWay(pose, place);
  // Seen from below, what turns to the right in the picture turns to the left.
  const turn = (angle - done.angle) * (dot(pose.direction, upAt(place)) > 0 ? -1 : 1);
  const scale = way === "hands" && spread > 0 && done.spread > 0 ? done.spread / spread : 1;
  const turned = turn === 0 ? pose : orbit(pose, place, turn, 0);
  const zoomed = mover.zoom(turned, place, scale);
  return panTo(zoomed, mover.lens, place, at, held.pan);
}
