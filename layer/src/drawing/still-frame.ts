import type { FrameCamera } from "./frame-camera.js";

/** What a frame rested on: numbers and objects. */
export type FrameGround = readonly unknown[];

/**
 * Remembers what the last frame rested on that showed all there is. As long as nothing of that changes, a further frame would
 * show the same, so that nothing of it has to be found out anew.
 */
export class StillFrame {
  #ground: FrameGround | undefined;

  /** Whether there is such a frame. */
  get stands(): boolean {
    return this.#ground !== undefined;
  }

  /** Whether the next frame rests on the same. */
  holds(ground: FrameGround): boolean {
    return restsOn(ground, this.#ground);
  }

  /** Takes note of a frame. @param ground undefined where a further frame may show more */
  note(ground: FrameGround | undefined): void {
    this.#ground = ground;
  }
}

/**
 * Share of a number by which a camera may be another one and stand where it stood. Each time that Cesium looks at its heading,
 * which it may do in every frame, it turns the camera by its own rounding.
 */
const ROUNDING = 1e-12;

/** Whether all is the same, but for the rounding of numbers. */
export function restsOn(a: FrameGround, b: FrameGround | undefined): boolean {
  if (a.length !== b?.length) return false;
  for (let at = 0; at < a.length; at++) if (!sameButRounded(a[at], b[at])) return false;
  return true;
}

function sameButRounded(a: unknown, b: unknown): boolean {
  if (Object.is(a, b)) return true;
  if (typeof a !== "number" || typeof b !== "number") return false;
  return Math.abs(a - b) <= ROUNDING * Math.max(1, Math.min(Math.abs(a), Math.abs(b)));
}

/** Whether all is the same, each number to its last bit. */
export function sameGround(a: FrameGround, b: FrameGround | undefined): boolean {
  if (a.length !== b?.length) return false;
  for (let at = 0; at < a.length; at++) if (!Object.is(a[at], b[at])) return false;
  return true;
}

/** All numbers of a camera. */
export function cameraGround({ view, width, pixelRatio, near, depth }: FrameCamera): FrameGround {
  const { position, direction, planes, height, projection, horizon } = view;
  const { kind } = projection;
  const lens = kind === "perspective" ? projection.fieldOfView : projection.extent;
  return [
    ...[width, height, pixelRatio, near, depth.own, depth.scene, kind, lens, horizon],
    ...[...Array.from(position), ...Array.from(direction), ...Array.from(planes)],
  ];
}
