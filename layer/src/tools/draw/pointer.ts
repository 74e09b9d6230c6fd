import type { ScreenPoint } from "./view-adapter.js";

/** Pixels that a pointer may move and still have clicked. */
const STILL = 6;

/** What a pointer does to a view. */
export interface PointerEvents {
  readonly clicked: (at: ScreenPoint) => void;
  readonly moved: (at: ScreenPoint) => void;
}

/**
 * Tells clicks and taps from drags, which are the view's own. Listens on until the signal is aborted.
 * @param active whether anything is told at the moment
 */
export function watchPointer(
  element: HTMLElement,
  { clicked, moved }: PointerEvents,
  active: () => boolean,
  signal: AbortSignal,
): void {
  let down: (ScreenPoint & { readonly pointer: number }) | undefined;
  element.addEventListener(
    "pointerdown",
    (event) => {
      // A second finger makes a pinch of it.
      down =
        down || event.button !== 0 ? undefined : { ...placeIn(element, event), pointer: event.pointerId };
    },
    { signal },
  );
  element.addEventListener(
    "pointermove",
    (event) => {
      if (active() && event.buttons === 0) moved(placeIn(element, event));
    },
    { signal },
  );
  const end = (event: PointerEvent) => {
    const began = down;
    down = undefined;
    if (event.type !== "pointerup" || began?.pointer !== event.pointerId || !active()) return;
    const at = placeIn(element, event);
    if (Math.hypot(at.x - began.x, at.y - began.y) <= STILL) clicked(at);
  };
  element.addEventListener("pointerup", end, { signal });
  element.addEventListener("pointercancel", end, { signal });
}

/** Where a pointer is in an element, CSS pixels. */
export function placeIn(element: HTMLElement, { clientX, clientY }: PointerEvent): ScreenPoint {
  const { left, top } = element.getBoundingClientRect();
  return { x: clientX - left, y: clientY - top };
}

/** Pixels that an arrow key moves the crosshair or a vertex; with Shift one. */
const STEP = 10;

/** Where an arrow key leads, pixels; undefined for other keys. */
export function stepOf({ key, shiftKey }: KeyboardEvent): ScreenPoint | undefined {
  const step = shiftKey ? 1 : STEP;
  switch (key) {
    case "ArrowLeft":
      return { x: -step, y: 0 };
    case "ArrowRight":
      return { x: step, y: 0 };
    case "ArrowUp":
      return { x: 0, y: -step };
    case "ArrowDown":
      return { x: 0, y: step };
    default:
      return undefined;
  }
}

/** What a key means to the tool; undefined where it means nothing. @param drawing whether a figure is being drawn */
export function commandOf(
  { ctrlKey, metaKey, altKey, shiftKey, key }: KeyboardEvent,
  drawing: boolean,
): "undo" | "redo" | "cancel" | "leave" | undefined {
  const chord = ctrlKey || metaKey;
  const letter = key.toLowerCase();
  if (chord && letter === "z") return shiftKey ? "redo" : "undo";
  if (chord && letter === "y") return "redo";
  if (chord || altKey) return undefined;
  if (key === "Escape") return drawing ? "cancel" : "leave";
  return drawing && (key === "Backspace" || key === "Delete") ? "undo" : undefined;
}
