import { isAbort } from "../../errors/index.js";
import {
  attached,
  MEASUREMENT_KINDS,
  type MeasuredCloud,
  type Measurement,
  type MeasurementKind,
  MeasureUnits,
  type NamedValue,
  type Reading,
  Readings,
  readsPoints,
  type Vertex,
  type WorthOptions,
} from "../measure/index.js";
import { checkPrecision } from "../measure/worth/point-errors.js";
import { Awaited } from "./awaited.js";
import { figuresOf } from "./figures.js";
import { checkChange, checkKind, checkMeasurement, type MeasureToolOptions } from "./given.js";
import { freshName, grown, History, type MeasurementChange, withAdded, withChange } from "./history.js";
import { KnownValues } from "./known-values.js";
import { commandOf } from "./pointer.js";
import { Surface } from "./surface.js";
import type { ViewAdapter } from "./view-adapter.js";
import { type MeasureWords, measureWords } from "./words.js";

/**
 * Draws measurements on one or several views, by pointer, touch or keyboard, and keeps them.
 *
 * Click places a vertex on the point there, or takes a vertex that is there; a click on the last vertex ends the figure,
 * as does one on the first vertex of an area. Keys: arrows move a crosshair (Shift: by a pixel), Enter or Space places,
 * Enter in the same place ends; Backspace takes the last vertex back, Escape gives the figure up; Ctrl+Z and Ctrl+Y undo
 * and redo. Of the measurement being edited each vertex takes the keyboard: arrows, Delete, Insert.
 */
export class MeasureTool {
  /** What is said to people. */
  readonly words: MeasureWords;
  readonly #options: MeasureToolOptions;
  readonly #history = new History();
  readonly #surfaces: Surface[] = [];
  readonly #turns = { last: Promise.resolve() as Promise<unknown> };
  readonly #listeners = new Set<() => void>();
  readonly #readings: Readings;
  /** Data sets that are at hand, beside those that vertices stand on. */
  #clouds: readonly MeasuredCloud[] = [];
  /** The view that the reader turned to last. */
  #used: Surface | undefined;
  #destroyed = false;
  #units: MeasureUnits;
  readonly #values: KnownValues;
  #edited: string | undefined;
  #waiting: Awaited | undefined;
  #hover: Vertex | undefined;
  #missed = false;

  constructor(view: ViewAdapter, options: MeasureToolOptions = {}) {
    this.#options = options;
    const { terrain, createWorker, units, precision, words } = options;
    this.words = measureWords(words);
    this.#units = units ?? new MeasureUnits();
    this.#values = new KnownValues({ precision });
    this.#readings = new Readings(
      () => ({ ...this.worth, terrain, createWorker, clouds: this.#clouds }),
      // What is read moves no figure: no view need draw for it.
      () => this.#told(),
    );
    this.addView(view);
  }

  /**
   * Draws on a further view too: what is measured is shown on all of them, and a figure that was begun on one is ended on
   * another.
   * @returns what takes it off that view
   */
  addView(view: ViewAdapter): () => void {
    const surface = new Surface(view, {
      ...{ turns: this.#turns, words: this.words },
      measurements: () => this.measurements,
      draft: () => this.#history.present.draft,
      placed: (vertex) => this.#add(vertex),
      ahead: (vertex, from) => this.#ahead(vertex, from),
      reshape: (id, vertices) => this.change(id, { vertices }),
      chosen: (id) => this.edit(id),
      used: (one) => {
        this.#used = one;
      },
      key: (event) => this.#key(event),
      covering: () => this.#options.covering?.() ?? [],
      show: () => this.#show(),
      told: (work) => this.#watched(work),
    });
    this.#surfaces.push(surface);
    this.#used ??= surface;
    this.#show();
    return () => {
      const at = this.#surfaces.indexOf(surface);
      if (at < 0) return;
      this.#surfaces.splice(at, 1);
      surface.destroy();
      if (this.#used === surface) this.#used = this.#surfaces[0];
    };
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

  /** These vertices. */
  get drawnVertices(): readonly Vertex[] {
    return this.#history.present.draft?.vertices ?? [];
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
    return this.#values.worth;
  }

  /** @throws MeasureError MEASURE_OPTION for a precision that is none */
  set worth(worth: WorthOptions) {
    if (typeof worth.precision !== "function") checkPrecision(worth.precision, "MeasureTool");
    this.#values.worth = worth;
    this.#readings.again(this.measurements.filter(readsPoints));
    this.#changed();
  }

  /**
   * What a measurement comes to; of a volume or a height above the ground, what is known by now.
   * @throws MeasureError where its vertices have no such value
   */
  valuesOf(measurement: Measurement): readonly NamedValue[] {
    const reading = this.#readings.of(measurement);
    const read = reading?.state === "done" ? reading.values : [];
    return [...read, ...this.#values.of(measurement)];
  }

  /** How far the reading of a measurement's values is; undefined where nothing is read for it. */
  readingOf(measurement: Measurement): Reading | undefined {
    return this.#readings.of(measurement);
  }

  /** Gives up reading for a measurement. */
  stopReading(measurement: Measurement): void {
    this.#readings.stop(measurement);
  }

  /** Has the values of a measurement read anew. */
  readAgain(measurement: Measurement): void {
    this.#readings.again([measurement]);
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
   * @throws the signal's reason when aborted; MeasureError MEASURE_OPTION for a kind that there is not
   */
  async draw(
    kind: MeasurementKind,
    options: { signal?: AbortSignal } = {},
  ): Promise<Measurement | undefined> {
    const { signal } = options;
    signal?.throwIfAborted();
    checkKind(kind);
    if (this.#destroyed) throw new DOMException("the measure tool is destroyed", "InvalidStateError");
    this.cancel();
    this.#edited = undefined;
    const awaited = new Awaited(signal, () => this.cancel());
    this.#waiting = awaited;
    this.#history.begin(kind);
    this.#changed();
    // The view that was used last may be hidden now.
    if (!this.#used?.focus()) this.#surfaces.find((surface) => surface.focus());
    return awaited.done;
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

  volume(options: { signal?: AbortSignal } = {}): Promise<Measurement | undefined> {
    return this.draw("volume", options);
  }

  /** Ends the figure that is being drawn, where it has vertices enough. @returns whether it did */
  finish(): boolean {
    const { draft, measurements } = this.#history.present;
    if (!draft || draft.vertices.length < MEASUREMENT_KINDS[draft.kind].least) return false;
    const { kind, vertices } = draft;
    const waiting = this.#waiting;
    const name = freshName(measurements, this.words.kind(kind));
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
    if (draft?.vertices.length) this.#history.go({ measurements, draft: undefined });
    else if (draft) this.#history.giveUp();
    this.#rest();
    waiting?.resolve(undefined);
  }

  /** Lets the vertices of a measurement be moved, added and taken out; undefined: of none. */
  edit(id: string | undefined): void {
    if (this.drawing) return;
    this.#edited = id;
    this.#changed();
  }

  /** Another name, other vertices, another base: one step of undo. @throws MeasureError MEASURE_VERTICES, MEASURE_OPTION */
  change(id: string, change: MeasurementChange): void {
    const { measurements, draft } = this.#history.present;
    const changed = measurements.find((one) => one.id === id);
    if (!changed) return;
    checkChange(changed.kind, change, changed.name);
    this.#history.go({ measurements: withChange(measurements, id, change), draft });
    this.#changed();
  }

  /** Takes a measurement out; `undo` brings it back. */
  remove(id: string): void {
    const { measurements, draft } = this.#history.present;
    this.#history.go({ measurements: measurements.filter((one) => one.id !== id), draft });
    this.#changed();
  }

  /**
   * Adds measurements, of a file say. One whose `id` is taken gets another.
   * @throws MeasureError MEASURE_OPTION, MEASURE_VERTICES where one of them is none, and nothing is added
   */
  add(added: readonly Measurement[]): void {
    for (const one of added) checkMeasurement(one);
    const { measurements, draft } = this.#history.present;
    this.#history.go({ measurements: withAdded(measurements, added), draft });
    this.#changed();
  }

  /**
   * Puts vertices on data sets that were opened since, or opened anew with another system: they stand on the same records
   * and have their places from these. Volumes may be measured against them.
   */
  attach(clouds: readonly MeasuredCloud[]): void {
    this.#clouds = clouds;
    this.#history.replaceVertices((vertex) => attached(vertex, clouds));
    this.#changed();
  }

  undo(): void {
    if (this.#history.undo()) this.#moved();
  }

  redo(): void {
    if (this.#history.redo()) this.#moved();
  }

  /** Whoever waits for a figure that is no longer drawn waits no longer. */
  #moved(): void {
    if (this.drawing) this.#changed();
    else this.cancel();
  }

  /** Takes all figures off the views. */
  destroy(): void {
    this.cancel();
    this.#destroyed = true;
    this.#readings.destroy();
    for (const surface of this.#surfaces.splice(0)) surface.destroy();
    this.#listeners.clear();
  }

  #rest(): void {
    this.#waiting = undefined;
    [this.#hover, this.#missed] = [undefined, false];
    for (const surface of this.#surfaces) surface.rest();
    this.#changed();
  }

  #changed(): void {
    if (this.#destroyed) return;
    this.#readings.follow(this.measurements);
    this.#told();
    for (const { view } of this.#surfaces) view.redraw();
  }

  #told(): void {
    if (this.#destroyed) return;
    this.#show();
    for (const listener of this.#listeners) listener();
  }

  #show(): void {
    const drag = this.#surfaces.map(({ grips }) => grips.drag).find((one) => one !== undefined);
    const figures = figuresOf(this.#history.present, {
      ...{ edited: this.#edited, drag, ahead: this.#hover, missed: this.#missed },
      ...{ units: this.#units, words: this.words, worth: this.worth },
      ...{ valuesOf: (one) => this.#values.of(one), readingOf: (one) => this.#readings.of(one) },
    });
    for (const surface of this.#surfaces) surface.show(figures);
  }

  #add(vertex: Vertex | undefined): void {
    const { measurements, draft } = this.#history.present;
    if (!draft) return;
    this.#missed = !vertex;
    if (!vertex) {
      this.#show();
      return;
    }
    const { vertices, ends } = grown(draft, vertex);
    if (vertices !== draft.vertices) {
      this.#hover = undefined;
      this.#history.go({ measurements, draft: { kind: draft.kind, vertices } });
    }
    if (ends) this.finish();
    else this.#changed();
  }

  #ahead(vertex: Vertex | undefined, from: Surface): void {
    for (const surface of this.#surfaces) if (surface !== from) surface.rest();
    if (!vertex && !this.#missed) return;
    this.#missed = false;
    this.#hover = vertex ?? this.#hover;
    this.#show();
  }

  /** @returns whether the key means anything */
  #key(event: KeyboardEvent): boolean {
    const command = commandOf(event, this.drawing !== undefined);
    if (command === "leave") this.edit(undefined);
    else if (command) this[command]();
    return command !== undefined;
  }

  /** Has failures told; what was given up is none. */
  #watched(work: Promise<unknown>): void {
    work.catch((thrown: unknown) => {
      if (this.#destroyed || isAbort(thrown)) return;
      (this.#options.onError ?? reportError)(thrown);
    });
  }
}
