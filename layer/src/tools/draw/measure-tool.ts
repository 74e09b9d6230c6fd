import { isAbort } from "../../errors/index.js";
import {
  attached,
  MEASUREMENT_KINDS,
  type MeasuredCloud,
  type Measurement,
  type MeasurementKind,
  MeasureUnits,
  type Vertex,
  type WorthOptions,
} from "../measure/index.js";
import { figuresOf } from "./figures.js";
import { Grips } from "./grips.js";
import { freshName, History, withVertices } from "./history.js";
import { Overlay, type ShownFigure } from "./overlay.js";
import { isSame, Placing, verticesOf } from "./placing.js";
import { stepOf, watchPointer } from "./pointer.js";
import type { ScreenPoint, ViewAdapter } from "./view-adapter.js";

export interface MeasureToolOptions extends WorthOptions {
  /** How labels are written. Default: metres and degrees, in the reader's language. */
  readonly units?: MeasureUnits | undefined;
  /** Hears what kept a record from being read. Default: `reportError`. */
  readonly onError?: ((thrown: unknown) => void) | undefined;
}

/** What waits for a figure to be finished. */
interface Waiting {
  readonly resolve: (measurement: Measurement | undefined) => void;
  readonly id: string;
}

/**
 * Draws measurements on a view, by pointer, touch or keyboard, and keeps them.
 *
 * Click places a vertex on the point there, or takes a vertex that is there; a click on the last vertex ends the figure,
 * as does one on the first vertex of an area. Keys: arrows move a crosshair (Shift: by a pixel), Enter or Space places,
 * Enter in the same place ends; Backspace takes the last vertex back, Escape gives the figure up; Ctrl+Z and Ctrl+Y undo
 * and redo. Of the measurement being edited each vertex takes the keyboard: arrows, Delete, Insert.
 */
export class MeasureTool {
  readonly #view: ViewAdapter;
  readonly #options: MeasureToolOptions;
  readonly #end = new AbortController();
  readonly #placing: Placing;
  readonly #overlay: Overlay;
  readonly #grips: Grips;
  readonly #history = new History();
  readonly #listeners = new Set<() => void>();
  #units: MeasureUnits;
  #worth: WorthOptions;
  #edited: string | undefined;
  #waiting: Waiting | undefined;
  #hover: Vertex | undefined;
  #missed = false;

  constructor(view: ViewAdapter, options: MeasureToolOptions = {}) {
    this.#view = view;
    this.#options = options;
    this.#units = options.units ?? new MeasureUnits();
    this.#worth = { precision: options.precision };
    const { signal } = this.#end;
    this.#placing = new Placing(view, signal);
    this.#overlay = new Overlay(view, {
      grabbed: (grip, event) => this.#grips.grab(grip, event),
      key: (grip, event) => this.#grips.key(grip, event),
      chosen: (id) => this.edit(id),
    });
    this.#grips = new Grips({
      ...{ view, placing: this.#placing, overlay: this.#overlay },
      measurements: () => this.measurements,
      reshape: (id, vertices) => this.#reshape(id, vertices),
      show: () => this.#overlay.show(this.#figures()),
      told: (work) => this.#told(work),
    });
    const active = () => this.#history.present.draft !== undefined;
    const { element } = view;
    watchPointer(
      element,
      { clicked: (at) => this.#place(at), moved: (at) => this.#moved(at) },
      active,
      signal,
    );
    for (const target of [element, this.#overlay.root]) {
      target.addEventListener("keydown", (event) => this.#viewKey(event), { signal });
    }
  }

  /** All that is measured, in the order in which it was. */
  get measurements(): readonly Measurement[] {
    return this.#history.present.measurements;
  }

  /** What is being drawn. */
  get drawing(): MeasurementKind | undefined {
    return this.#history.present.draft?.kind;
  }

  /** How many vertices it has so far. */
  get drawn(): number {
    return this.#history.present.draft?.vertices.length ?? 0;
  }

  /** The measurement whose vertices can be taken hold of. */
  get edited(): Measurement | undefined {
    return this.measurements.find(({ id }) => id === this.#edited);
  }

  get canUndo(): boolean {
    return this.#history.canUndo;
  }

  get canRedo(): boolean {
    return this.#history.canRedo;
  }

  get units(): MeasureUnits {
    return this.#units;
  }

  set units(units: MeasureUnits) {
    this.#units = units;
    this.#changed();
  }

  /** What is known of the points; see {@link WorthOptions}. */
  get worth(): WorthOptions {
    return this.#worth;
  }

  set worth(worth: WorthOptions) {
    this.#worth = worth;
    this.#changed();
  }

  /** Calls back after every change. @returns what ends that */
  onChange(listener: () => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /**
   * Has the reader draw a figure; one that was being drawn is given up.
   * @returns undefined where the reader gives it up
   * @throws the signal's reason when aborted
   */
  async draw(
    kind: MeasurementKind,
    options: { signal?: AbortSignal } = {},
  ): Promise<Measurement | undefined> {
    const { signal } = options;
    signal?.throwIfAborted();
    this.cancel();
    this.#edited = undefined;
    const id = crypto.randomUUID();
    this.#history.go({ ...this.#history.present, draft: { kind, vertices: [] } });
    const done = new Promise<Measurement | undefined>((resolve, reject) => {
      const stop = () => {
        this.cancel();
        reject(signal!.reason);
      };
      signal?.addEventListener("abort", stop);
      const settled = (measurement: Measurement | undefined) => {
        signal?.removeEventListener("abort", stop);
        resolve(measurement);
      };
      this.#waiting = { resolve: settled, id };
    });
    const { element } = this.#view;
    if (element.tabIndex < 0) element.tabIndex = 0;
    element.focus({ preventScroll: true });
    this.#changed();
    return done;
  }

  /** A point's coordinates; see {@link draw}, as of the others. */
  point(options: { signal?: AbortSignal } = {}): Promise<Measurement | undefined> {
    return this.draw("point", options);
  }

  distance(options: { signal?: AbortSignal } = {}): Promise<Measurement | undefined> {
    return this.draw("distance", options);
  }

  polyline(options: { signal?: AbortSignal } = {}): Promise<Measurement | undefined> {
    return this.draw("polyline", options);
  }

  area(options: { signal?: AbortSignal } = {}): Promise<Measurement | undefined> {
    return this.draw("area", options);
  }

  /** Ends the figure that is being drawn, where it has vertices enough. @returns whether it did */
  finish(): boolean {
    const { draft, measurements } = this.#history.present;
    if (!draft || draft.vertices.length < MEASUREMENT_KINDS[draft.kind].least) return false;
    const { kind, vertices } = draft;
    const waiting = this.#waiting;
    const name = freshName(measurements, MEASUREMENT_KINDS[kind].title);
    const measurement = { id: waiting?.id ?? crypto.randomUUID(), kind, name, vertices };
    this.#history.go({ measurements: [...measurements, measurement], draft: undefined });
    this.#rest();
    waiting?.resolve(measurement);
    return true;
  }

  /** Gives up the figure that is being drawn; `undo` brings it back. */
  cancel(): void {
    const { draft, measurements } = this.#history.present;
    const waiting = this.#waiting;
    if (draft) this.#history.go({ measurements, draft: undefined });
    this.#rest();
    waiting?.resolve(undefined);
  }

  /** Lets the vertices of a measurement be moved, added and taken out; undefined: of none. */
  edit(id: string | undefined): void {
    if (this.drawing) return;
    this.#edited = id;
    this.#changed();
  }

  /** Takes a measurement out; `undo` brings it back. */
  remove(id: string): void {
    const { measurements, draft } = this.#history.present;
    this.#history.go({ measurements: measurements.filter((one) => one.id !== id), draft });
    this.#changed();
  }

  /** Adds measurements, of a file say. One whose `id` is taken gets another. */
  add(added: readonly Measurement[]): void {
    const { measurements, draft } = this.#history.present;
    const ids = new Set(measurements.map(({ id }) => id));
    const fresh = added.map((one) => (ids.has(one.id) ? { ...one, id: crypto.randomUUID() } : one));
    this.#history.go({ measurements: [...measurements, ...fresh], draft });
    this.#changed();
  }

  /**
   * Puts vertices on data sets that were opened since, or opened anew with another system: they stand on the same records
   * and have their places from these.
   */
  attach(clouds: readonly MeasuredCloud[]): void {
    this.#history.replaceVertices((vertex) => attached(vertex, clouds));
    this.#changed();
  }

  undo(): void {
    if (this.#history.undo()) this.#changed();
  }

  redo(): void {
    if (this.#history.redo()) this.#changed();
  }

  /** Takes all figures off the view. */
  destroy(): void {
    this.cancel();
    this.#end.abort();
    this.#overlay.destroy();
    this.#listeners.clear();
  }

  #rest(): void {
    this.#waiting = undefined;
    this.#hover = undefined;
    this.#missed = false;
    this.#overlay.crosshair = undefined;
    this.#overlay.pointer = undefined;
    this.#changed();
  }

  #changed(): void {
    if (this.#end.signal.aborted) return;
    this.#overlay.show(this.#figures());
    this.#view.redraw();
    for (const listener of this.#listeners) listener();
  }

  #place(at: ScreenPoint): void {
    const { measurements, draft } = this.#history.present;
    this.#told(this.#placing.place(at, verticesOf(measurements, draft), (vertex) => this.#add(vertex)));
  }

  #add(vertex: Vertex | undefined): void {
    const { measurements, draft } = this.#history.present;
    if (!draft) return;
    this.#missed = !vertex;
    if (!vertex) {
      this.#overlay.show(this.#figures());
      return;
    }
    const { kind, vertices } = draft;
    const { shape, most } = MEASUREMENT_KINDS[kind];
    const last = vertices[vertices.length - 1];
    const closes = shape === "ring" && vertices.length > 2 && isSame(vertices[0], vertex);
    if (closes || (last && isSame(last, vertex))) {
      this.finish();
      return;
    }
    this.#hover = undefined;
    this.#history.go({ measurements, draft: { kind, vertices: [...vertices, vertex] } });
    if (vertices.length + 1 === most) this.finish();
    else this.#changed();
  }

  #moved(at: ScreenPoint): void {
    const { draft, measurements } = this.#history.present;
    if (!draft) return;
    this.#overlay.crosshair = undefined;
    this.#overlay.pointer = at;
    if (this.#missed) {
      this.#missed = false;
      this.#overlay.show(this.#figures());
    } else this.#overlay.layout();
    const looking = this.#placing.look(at, verticesOf(measurements, draft)).then((vertex) => {
      if (!vertex || this.#history.present.draft !== draft) return;
      this.#hover = vertex;
      this.#overlay.show(this.#figures());
    });
    this.#told(looking);
  }

  #viewKey(event: KeyboardEvent): void {
    if (event.defaultPrevented) return;
    const chord = event.ctrlKey || event.metaKey;
    const key = event.key.toLowerCase();
    if (chord && key === "z") event.shiftKey ? this.redo() : this.undo();
    else if (chord && key === "y") this.redo();
    else if (chord || event.altKey) return;
    else if (event.key === "Escape") this.drawing ? this.cancel() : this.edit(undefined);
    else if (!this.drawing || !this.#drawKey(event)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** @returns whether the key means anything to a figure that is being drawn */
  #drawKey(event: KeyboardEvent): boolean {
    const { clientWidth, clientHeight } = this.#view.element;
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
    } else if (event.key === "Backspace" || event.key === "Delete") this.undo();
    else return false;
    return true;
  }

  /** Gives a measurement other vertices. */
  #reshape(id: string, vertices: readonly Vertex[]): void {
    const { measurements, draft } = this.#history.present;
    this.#history.go({ measurements: withVertices(measurements, id, vertices), draft });
    this.#changed();
  }

  #figures(): ShownFigure[] {
    return figuresOf(this.#history.present, {
      ...{ edited: this.#edited, drag: this.#grips.drag, ahead: this.#hover, missed: this.#missed },
      ...{ units: this.#units, worth: this.#worth },
    });
  }

  /** Has failures told; what was given up is none. */
  #told(work: Promise<unknown>): void {
    work.catch((thrown: unknown) => {
      if (this.#end.signal.aborted || isAbort(thrown)) return;
      (this.#options.onError ?? reportError)(thrown);
    });
  }
}
