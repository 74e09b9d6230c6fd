import type { ScreenPlace } from "../camera/index.js";

/** What pointers on the canvas are and do, as a navigation needs to know it. */
export interface Drag {
  readonly pointers: "mouse" | "touch";
  /** Fingers, or the button of the mouse: 0 left, 1 middle, 2 right. */
  readonly number: number;
  readonly shift: boolean;
  readonly control: boolean;
  /** Middle of the pointers, CSS pixels of the canvas. */
  readonly start: ScreenPlace;
  at: ScreenPlace;
  /** Pixels between the first two fingers, and the angle in which they lie, radians clockwise. */
  spread: number;
  angle: number;
}

/** Hears of drags. */
export interface DragEvents {
  /** Pointers went far enough to be no click. */
  began(drag: Drag): void;
  ended(): void;
  wheel(at: ScreenPlace, nearer: number): void;
  doubled(at: ScreenPlace): void;
}

/** CSS pixels that pointers go before they drag. */
const STILL = 4;
/** How many times a wheel makes the distance smaller: e to the power of pixels over this. */
const WHEEL = 400;
/** Milliseconds and pixels within which two taps are one that is double. */
const DOUBLE = { time: 400, pixels: 24 };
/** Pixels of a line and of a page, where a wheel counts in them. */
const LINES = [1, 40, 800] as const;
/** A pinch of a touch pad comes as small turns of a wheel with the control key. */
const PINCH = 8;

/** Follows the pointers on a canvas: one drag at a time, of the mouse or of as many fingers as are down. */
export class Pointers {
  readonly #canvas: HTMLCanvasElement;
  readonly #events: DragEvents;
  readonly #end = new AbortController();
  readonly #down = new Map<number, ScreenPlace>();
  #pressed: (Drag & { began: boolean }) | undefined;
  /** Whether it was a finger that was put down last. */
  #touched = false;
  #tapped: { readonly at: ScreenPlace; readonly time: number } | undefined;

  constructor(canvas: HTMLCanvasElement, events: DragEvents) {
    this.#canvas = canvas;
    this.#events = events;
    const { signal } = this.#end;
    const hear = (
      type: "pointerdown" | "pointermove" | "pointerup" | "pointercancel",
      what: (event: PointerEvent) => void,
    ) => canvas.addEventListener(type, what, { signal });
    hear("pointerdown", (event) => {
      this.#touched = event.pointerType === "touch";
      this.#down.set(event.pointerId, this.#placeOf(event));
      this.#press(event);
    });
    hear("pointermove", (event) => this.#move(event));
    for (const type of ["pointerup", "pointercancel"] as const) {
      hear(type, (event) => {
        // The way between the last move that was told and the place where it is let go is a part of it.
        if (type === "pointerup") this.#move(event);
        if (type === "pointerup" && this.#down.size === 1) this.#tap(event.timeStamp);
        if (this.#down.delete(event.pointerId)) this.#press(event);
      });
    }
    canvas.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        const pixels = event.deltaY * (LINES[event.deltaMode] ?? 1) * (event.ctrlKey ? PINCH : 1);
        events.wheel(this.#placeOf(event), -pixels / WHEEL);
      },
      { signal, passive: false },
    );
    canvas.addEventListener(
      "dblclick",
      (event) => {
        // Some browsers tell of a double tap as well.
        if (!this.#touched) events.doubled(this.#placeOf(event));
      },
      { signal },
    );
  }

  /** Nothing more is dragged until pointers are pressed anew. */
  drop(): void {
    if (this.#pressed?.began) this.#events.ended();
    this.#pressed = undefined;
  }

  destroy(): void {
    this.drop();
    this.#end.abort();
  }

  /** The pointers that are down have become others. */
  #press({ pointerType, button, shiftKey, ctrlKey, metaKey }: PointerEvent): void {
    this.drop();
    if (this.#down.size === 0) return;
    const pointers = pointerType === "touch" ? "touch" : "mouse";
    const { at, spread, angle } = this.#shape();
    this.#pressed = {
      ...{ pointers, number: pointers === "touch" ? this.#down.size : button, began: false },
      ...{ shift: shiftKey, control: ctrlKey || metaKey },
      ...{ start: at, at, spread, angle },
    };
  }

  /** The last pointer was let go: browsers tell of no double tap where a page takes the gestures of touch. */
  #tap(time: number): void {
    const drag = this.#pressed;
    const last = this.#tapped;
    this.#tapped = undefined;
    if (!drag || drag.began || drag.pointers !== "touch" || drag.number !== 1) return;
    const { at } = drag;
    const near = last && Math.hypot(at.x - last.at.x, at.y - last.at.y) < DOUBLE.pixels;
    if (near && time - last.time < DOUBLE.time) this.#events.doubled(at);
    else this.#tapped = { at, time };
  }

  #move(event: PointerEvent): void {
    if (!this.#down.has(event.pointerId)) return;
    const before = this.#shape();
    this.#down.set(event.pointerId, this.#placeOf(event));
    const drag = this.#pressed;
    if (!drag) return;
    const now = this.#shape();
    const { start } = drag;
    const gone = Math.hypot(now.at.x - start.x, now.at.y - start.y);
    if (!drag.began && (gone > STILL || Math.abs(now.spread - drag.spread) > STILL)) {
      // The browser goes on telling of pointers that leave the canvas.
      if (event.isTrusted) this.#canvas.setPointerCapture(event.pointerId);
      drag.began = true;
      this.#events.began(drag);
    }
    if (!drag.began) return;
    // Fingers that pass 180° turn on.
    drag.angle += Math.atan2(Math.sin(now.angle - before.angle), Math.cos(now.angle - before.angle));
    drag.spread = now.spread;
    drag.at = now.at;
  }

  #shape(): { at: ScreenPlace; spread: number; angle: number } {
    const places = [...this.#down.values()];
    const sum = (axis: "x" | "y") => places.reduce((total, place) => total + place[axis], 0) / places.length;
    const [a, b] = places;
    const at = { x: sum("x"), y: sum("y") };
    if (!a || !b) return { at, spread: 0, angle: 0 };
    return { at, spread: Math.hypot(b.x - a.x, b.y - a.y), angle: Math.atan2(b.y - a.y, b.x - a.x) };
  }

  #placeOf({ clientX, clientY }: MouseEvent): ScreenPlace {
    const { left, top } = this.#canvas.getBoundingClientRect();
    return { x: clientX - left, y: clientY - top };
  }
}
