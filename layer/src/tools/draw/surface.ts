import type { Measurement, Vertex } from "../measure/index.js";
import type { Grip } from "./grip.js";
import { Grips } from "./grips.js";
import type { Draft } from "./history.js";
import { Overlay, type ShownFigure } from "./overlay.js";
import { Placing, type Turns } from "./placing.js";
import { stepOf, watchPointer } from "./pointer.js";
import { type Snaps, snapsOf } from "./snapping.js";
import { DRAWING_CLASS, type ScreenPoint, type ViewAdapter } from "./view-adapter.js";
import type { MeasureWords } from "./words.js";

/** What is drawn, as a view needs it. */
export interface SurfaceHost {
  readonly turns: Turns;
  readonly words: MeasureWords;
  measurements(): readonly Measurement[];
  draft(): Draft | undefined;
  /** Adds a vertex to the figure being drawn; undefined where there is no point. */
  placed(vertex: Vertex | undefined): void;
  /** Where the figure being drawn would go on; undefined while that is looked for. */
  ahead(vertex: Vertex | undefined, from: Surface): void;
  /** Gives a measurement other vertices, one step of undo. */
  reshape(id: string, vertices: readonly Vertex[]): void;
  chosen(id: string): void;
  /** The reader turns to this view. */
  used(surface: Surface): void;
  /** A key that this view has no use for. @returns whether it meant anything */
  key(event: KeyboardEvent): boolean;
  /** Elements that lie over the views. */
  covering(): readonly Element[];
  /** Has every view show what is drawn. */
  show(): void;
  /** Has failures told. */
  told(work: Promise<unknown>): void;
}

/** One of the views that measurements are drawn on: what is done there by pointer and keys, and what is shown. */
export class Surface {
  readonly view: ViewAdapter;
  readonly grips: Grips;
  readonly #host: SurfaceHost;
  readonly #end = new AbortController();
  readonly #placing: Placing;
  readonly #overlay: Overlay;
  #drawing = false;

  constructor(view: ViewAdapter, host: SurfaceHost) {
    this.view = view;
    this.#host = host;
    const { signal } = this.#end;
    this.#placing = new Placing(view, host.turns, signal);
    const events = {
      grabbed: (grip: Grip, event: PointerEvent) => this.grips.grab(grip, event),
      key: (grip: Grip, event: KeyboardEvent) => this.grips.key(grip, event),
      chosen: (id: string) => host.chosen(id),
    };
    const covering = () => [...host.covering(), ...(view.covering?.() ?? [])];
    this.#overlay = new Overlay(view, events, host.words, covering);
    this.grips = new Grips({
      ...{ view, placing: this.#placing, overlay: this.#overlay },
      measurements: () => host.measurements(),
      reshape: (id, vertices) => host.reshape(id, vertices),
      show: () => host.show(),
      told: (work) => host.told(work),
    });
    watchPointer(
      view.element,
      { clicked: (at) => this.#place(at), moved: (at) => this.#moved(at) },
      () => host.draft() !== undefined,
      signal,
    );
    for (const target of [view.element, this.#overlay.root]) {
      target.addEventListener("keydown", (event) => this.#key(event), { signal });
      for (const type of ["pointerdown", "focusin"]) {
        target.addEventListener(type, () => host.used(this), { signal });
      }
    }
  }

  /** Gives the keyboard to the view. @returns whether it took it: one that is hidden or inert does not */
  focus(): boolean {
    const { element } = this.view;
    this.#reachable();
    element.focus({ preventScroll: true });
    return document.activeElement === element;
  }

  /** Lets the keyboard come to the view, from another one too. */
  #reachable(): void {
    const { element } = this.view;
    if (element.tabIndex < 0) element.tabIndex = 0;
  }

  show(figures: readonly ShownFigure[]): void {
    const drawing = this.#host.draft() !== undefined;
    if (drawing !== this.#drawing) this.view.drawing?.(drawing);
    if (drawing) this.#reachable();
    if (drawing !== this.#drawing) this.view.element.classList.toggle(DRAWING_CLASS, drawing);
    this.#drawing = drawing;
    this.#overlay.show(figures);
  }

  /** Nothing is pointed at any more. */
  rest(): void {
    this.#overlay.crosshair = undefined;
    this.#overlay.pointer = undefined;
  }

  destroy(): void {
    this.#end.abort();
    if (this.#drawing) {
      this.view.drawing?.(false);
      this.view.element.classList.remove(DRAWING_CLASS);
    }
    this.#overlay.destroy();
  }

  #snaps(): Snaps {
    return snapsOf(this.#host.measurements(), this.#host.draft());
  }

  #place(at: ScreenPoint): void {
    this.#host.told(this.#placing.place(at, this.#snaps(), (vertex) => this.#host.placed(vertex)));
  }

  #moved(at: ScreenPoint): void {
    const draft = this.#host.draft();
    if (!draft) return;
    this.#host.ahead(undefined, this);
    this.#overlay.crosshair = undefined;
    this.#overlay.pointer = at;
    this.#overlay.layout();
    const looking = this.#placing.look(at, this.#snaps()).then((vertex) => {
      if (vertex && this.#host.draft() === draft) this.#host.ahead(vertex, this);
    });
    this.#host.told(looking);
  }

  #key(event: KeyboardEvent): void {
    if (event.defaultPrevented || this.#othersDraw) return;
    const chord = event.ctrlKey || event.metaKey || event.altKey;
    const own = !chord && this.#host.draft() !== undefined && this.#drawKey(event);
    if (!own && !this.#host.key(event)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Whether another tool draws on this view: keys are its own until it has ended. */
  get #othersDraw(): boolean {
    return !this.#drawing && this.view.element.classList.contains(DRAWING_CLASS);
  }

  /** @returns whether the key means anything to a figure that is being drawn here */
  #drawKey(event: KeyboardEvent): boolean {
    const { clientWidth, clientHeight } = this.view.element;
    const at = this.#overlay.crosshair ?? { x: clientWidth / 2, y: clientHeight / 2 };
    const step = stepOf(event);
    if (step) {
      const inside = (value: number, size: number) => Math.min(size - 1, Math.max(0, value));
      const moved = { x: inside(at.x + step.x, clientWidth), y: inside(at.y + step.y, clientHeight) };
      this.#moved(moved);
      this.#overlay.crosshair = moved;
      this.#overlay.layout();
    } else if (event.key === "Enter" || event.key === " ") {
      this.#overlay.crosshair = at;
      this.#place(at);
    } else return false;
    return true;
  }
}
