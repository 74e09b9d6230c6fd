import type { NavigationMode } from "./options.js";

/** What keys that are held move, each from -1 to 1. */
export interface Rates {
  readonly ahead: number;
  readonly aside: number;
  readonly up: number;
  /** To the left. */
  readonly turn: number;
  /** Upwards. */
  readonly tilt: number;
  /** Nearer. */
  readonly zoom: number;
  readonly fast: boolean;
}

type Axis = Exclude<keyof Rates, "fast">;
type Push = readonly [Axis, 1 | -1];

/** What a key does once. */
export type KeyDeed = "north" | "down" | "mode" | "stop";

/** Keys of a navigation, as a sheet of help lists them; letters are those of a keyboard with QWERTY, by their place. */
export const NAVIGATION_KEYS: readonly {
  readonly keys: readonly string[];
  readonly mode?: NavigationMode;
  readonly deed: string;
}[] = [
  { keys: ["W", "A", "S", "D"], deed: "move ahead, left, back, right" },
  { keys: ["E", "Q"], deed: "move up, down" },
  { keys: ["Arrow keys"], mode: "orbit", deed: "move ahead, left, back, right" },
  { keys: ["Arrow keys"], mode: "walk", deed: "move ahead and back, turn left and right" },
  { keys: ["Shift + arrow keys"], deed: "turn and tilt" },
  { keys: ["+", "−"], deed: "nearer, farther" },
  { keys: ["Shift"], deed: "faster with W, A, S, D, E, Q" },
  { keys: ["N"], deed: "north up" },
  { keys: ["U"], deed: "look straight down" },
  { keys: ["F"], deed: "walk through the scene, and back" },
  { keys: ["Escape"], deed: "end a flight" },
];

const DEEDS: ReadonlyMap<string, KeyDeed> = new Map([
  ["KeyN", "north"],
  ["KeyU", "down"],
  ["KeyF", "mode"],
  ["Escape", "stop"],
]);

/** Keys by their place on the keyboard. */
const MOVES: ReadonlyMap<string, Push> = new Map<string, Push>([
  ["KeyW", ["ahead", 1]],
  ["KeyS", ["ahead", -1]],
  ["KeyA", ["aside", -1]],
  ["KeyD", ["aside", 1]],
  ["KeyE", ["up", 1]],
  ["KeyQ", ["up", -1]],
  ["PageUp", ["up", 1]],
  ["PageDown", ["up", -1]],
]);

const TURNS: ReadonlyMap<string, Push> = new Map<string, Push>([
  ["ArrowLeft", ["turn", 1]],
  ["ArrowRight", ["turn", -1]],
  ["ArrowUp", ["tilt", 1]],
  ["ArrowDown", ["tilt", -1]],
]);

const ARROWS: ReadonlyMap<string, Push> = new Map<string, Push>([
  ["ArrowLeft", ["aside", -1]],
  ["ArrowRight", ["aside", 1]],
  ["ArrowUp", ["ahead", 1]],
  ["ArrowDown", ["ahead", -1]],
]);

/** Signs, wherever a keyboard has them. */
const SIGNS: ReadonlyMap<string, Push> = new Map<string, Push>([
  ["+", ["zoom", 1]],
  ["=", ["zoom", 1]],
  ["-", ["zoom", -1]],
  ["_", ["zoom", -1]],
]);

/** Seconds for which a key counts at least, however short it is struck. */
const TAP = 0.1;

/** What a key moves while it is held, if anything. */
function pushOf({ code, key, shiftKey }: KeyboardEvent, mode: NavigationMode): Push | undefined {
  const sideways = code === "ArrowLeft" || code === "ArrowRight";
  if (shiftKey || (mode === "walk" && sideways)) {
    const turn = TURNS.get(code);
    if (turn) return turn;
  }
  return ARROWS.get(code) ?? MOVES.get(code) ?? SIGNS.get(key);
}

/** Keys that are held while the canvas has the keyboard. */
export class HeldKeys {
  /** By the code of the key: what it moves, and seconds that it still has to count for. */
  readonly #held = new Map<string, { readonly push: Push; owed: number; down: boolean }>();
  #fast = false;
  readonly #end = new AbortController();

  /**
   * @param mode asked for with each key
   * @param began called when a key begins to move the camera
   * @param deed called with what a key does once
   * @returns keys are left alone where these return false
   */
  constructor(
    canvas: HTMLCanvasElement,
    mode: () => NavigationMode | undefined,
    { began, deed }: { readonly began: () => void; readonly deed: (deed: KeyDeed) => void },
  ) {
    const { signal } = this.#end;
    const page = canvas.ownerDocument;
    // Heard after all who listen to the canvas itself, so that a tool which draws there comes first.
    page.addEventListener(
      "keydown",
      (event) => {
        const now = mode();
        if (event.target !== canvas || event.defaultPrevented || now === undefined) return;
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        this.#fast = event.shiftKey;
        const push = pushOf(event, now);
        const once = push ? undefined : DEEDS.get(event.code);
        if (!push && !once) return;
        event.preventDefault();
        if (once && !event.repeat) deed(once);
        if (!push) return;
        if (this.#held.size === 0) began();
        const { owed = TAP } = this.#held.get(event.code) ?? {};
        this.#held.set(event.code, { push, owed, down: true });
      },
      { signal },
    );
    page.addEventListener(
      "keyup",
      ({ code, shiftKey }) => {
        this.#fast = shiftKey;
        const key = this.#held.get(code);
        if (key) key.down = false;
      },
      { signal },
    );
    canvas.addEventListener("blur", () => this.release(), { signal });
  }

  /** Whether any key moves the camera. */
  get any(): boolean {
    return this.#held.size > 0;
  }

  /** What the keys move in the next so many seconds: rates times seconds. */
  take(seconds: number): Rates {
    const rates = { ahead: 0, aside: 0, up: 0, turn: 0, tilt: 0, zoom: 0 };
    for (const [code, key] of this.#held) {
      const [axis, sign] = key.push;
      const lasts = key.down ? seconds : Math.min(seconds, key.owed);
      rates[axis] += sign * lasts;
      key.owed = Math.max(0, key.owed - lasts);
      if (!key.down && key.owed === 0) this.#held.delete(code);
    }
    return { ...rates, fast: this.#fast };
  }

  /** All keys count as let go. */
  release(): void {
    this.#held.clear();
  }

  destroy(): void {
    this.#end.abort();
    this.release();
  }
}
