import type { Vector } from "@groma/georef";
import type { CameraPose, ScreenPlace } from "../camera/index.js";
import { orbit } from "./motions/index.js";
import type { Mover } from "./mover.js";
import { reducedMotion } from "./reduced-motion.js";

/** Seconds in which what is left to be done falls to a third. */
const EASE = 0.07;
/** What is left below which it is done at once. */
const DONE = 1e-4;
/** Milliseconds and pixels within which turns of the wheel are about the same place. */
const PAUSE = 600;
const STRAY = 4;

/** What is done little by little about a place: radians, and the natural logarithm of the distance. */
interface Glide {
  readonly pivot: Vector;
  zoom: number;
  turn: number;
  tilt: number;
}

/** Turns of the wheel about one place. */
interface Wheel {
  readonly at: ScreenPlace;
  time: number;
  /** What is not begun yet. */
  zoom: number;
  pivot: Vector | undefined;
}

/** Motions that go on by themselves for a moment: those of the wheel, and the way to north. */
export class Glides {
  #glide: Glide | undefined;
  #wheel: Wheel | undefined;

  /** Whether anything is still to be done. */
  get any(): boolean {
    return this.#glide !== undefined || (this.#wheel?.pivot !== undefined && this.#wheel.zoom !== 0);
  }

  stop(): void {
    this.#glide = undefined;
    this.#wheel = undefined;
  }

  /** Turns about a place from now on. @param turn radians to the left @param tilt radians upwards */
  begin(pivot: Vector, turn: number, tilt: number): void {
    this.stop();
    this.#glide = { pivot, turn, tilt, zoom: 0 };
  }

  /**
   * The wheel was turned.
   * @param nearer natural logarithm by which the distance is to shrink
   * @returns what is to be told of the place under it, once that is found; undefined where it is about the same as before
   */
  turnWheel(at: ScreenPlace, nearer: number): ((place: Vector) => void) | undefined {
    const time = performance.now();
    const last = this.#wheel;
    const near = last && Math.hypot(at.x - last.at.x, at.y - last.at.y) < STRAY;
    if (last && near && (!last.pivot || time - last.time < PAUSE)) {
      last.time = time;
      last.zoom -= nearer;
      return undefined;
    }
    const wheel: Wheel = { at, time, zoom: (last?.zoom ?? 0) - nearer, pivot: undefined };
    this.#wheel = wheel;
    return (place) => {
      wheel.pivot = place;
    };
  }

  /** The camera after so many seconds more. */
  goOn(pose: CameraPose, seconds: number, mover: Mover): CameraPose {
    const wheel = this.#wheel;
    if (wheel?.pivot && wheel.zoom !== 0) {
      const zoom = (this.#glide?.zoom ?? 0) + wheel.zoom;
      this.#glide = { pivot: wheel.pivot, zoom, turn: 0, tilt: 0 };
      wheel.zoom = 0;
    }
    const glide = this.#glide;
    if (!glide) return pose;
    const { turn, tilt, zoom, pivot } = glide;
    const left = Math.max(...[zoom, turn, tilt].map(Math.abs));
    const share = left < DONE || reducedMotion() ? 1 : 1 - Math.exp(-seconds / EASE);
    glide.zoom -= share * zoom;
    glide.turn -= share * turn;
    glide.tilt -= share * tilt;
    if (share === 1) this.#glide = undefined;
    const turned =
      turn === 0 && tilt === 0
        ? pose
        : orbit(pose, pivot, share * turn, share * tilt, mover.pitches(pivot, pose));
    return mover.zoom(turned, pivot, Math.exp(share * zoom));
  }
}
