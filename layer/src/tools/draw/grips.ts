import { MEASUREMENT_KINDS, type Measurement, type Vertex } from "../measure/index.js";
import { type Drag, dragged, type Grip } from "./grip.js";
import type { Overlay } from "./overlay.js";
import type { Placing } from "./placing.js";
import { placeIn, stepOf } from "./pointer.js";
import { type Snaps, snapsOf } from "./snapping.js";
import type { ScreenPoint, ViewAdapter } from "./view-adapter.js";

/** What moving of vertices needs. */
export interface GripsHost {
  readonly view: ViewAdapter;
  readonly placing: Placing;
  readonly overlay: Overlay;
  measurements(): readonly Measurement[];
  /** Gives a measurement other vertices, one step of undo. */
  reshape(id: string, vertices: readonly Vertex[]): void;
  /** Shows what is on its way. */
  show(): void;
  /** Has failures told. */
  told(work: Promise<unknown>): void;
}

/** By keyboard vertices are moved by pixels: what is near is no aim. */
const NOTHING: Snaps = { vertices: [], edges: [] };

/** Moves, adds and takes out vertices of the measurement being edited, by pointer or keyboard. */
export class Grips {
  readonly #host: GripsHost;
  #drag: Drag | undefined;

  constructor(host: GripsHost) {
    this.#host = host;
  }

  get drag(): Drag | undefined {
    return this.#drag;
  }

  grab(grip: Grip, event: PointerEvent): void {
    const { view, placing, overlay, show, told } = this.#host;
    const { target, pointerId } = event;
    if (event.button !== 0 || !(target instanceof Element)) return;
    event.preventDefault();
    event.stopPropagation();
    if (!grip.between) overlay.focus(grip.id, grip.vertex);
    target.setPointerCapture(pointerId);
    const drag: Drag = { grip, vertex: undefined };
    this.#drag = drag;
    const over = new AbortController();
    const held = this.#vertexOf(grip);
    const others = () => snapsOf(this.#host.measurements(), undefined, held);
    const look = async (at: ScreenPoint) => {
      const vertex = await placing.look(at, others());
      if (!vertex || this.#drag !== drag) return;
      drag.vertex = vertex;
      show();
    };
    const heard = (type: "pointermove" | "pointerup" | "pointercancel", work: (at: ScreenPoint) => void) =>
      target.addEventListener(type, (one) => work(placeIn(view.element, one as PointerEvent)), {
        signal: over.signal,
      });
    heard("pointermove", (at) => told(look(at)));
    heard("pointerup", (at) => {
      over.abort();
      told(placing.place(at, others(), (vertex) => this.#drop(drag, vertex)));
    });
    heard("pointercancel", () => {
      over.abort();
      this.#drop(drag, undefined);
    });
  }

  key(grip: Grip, event: KeyboardEvent): void {
    const { view, placing, told } = this.#host;
    const of = this.#measurementOf(grip);
    const at = of && view.project(of.vertices[grip.vertex]);
    if (!of || event.ctrlKey || event.metaKey || event.altKey) return;
    const step = stepOf(event);
    const { most } = MEASUREMENT_KINDS[of.kind];
    const count = of.vertices.length;
    const put = (place: ScreenPoint, into: Grip) =>
      told(placing.place(place, NOTHING, (vertex) => this.#put({ grip: into, vertex })));
    if (step && at) put({ x: at.x + step.x, y: at.y + step.y }, grip);
    else if (event.key === "Insert" && count < most && at) {
      const next = view.project(of.vertices[(grip.vertex + 1) % count], at) ?? at;
      put({ x: (at.x + next.x) / 2, y: (at.y + next.y) / 2 }, { ...grip, between: true });
    } else if (event.key === "Delete" || event.key === "Backspace") {
      told(this.#takeOut(of, grip.vertex));
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Ends a drag; a vertex that was let go where there is no point stays where it was. */
  #drop(drag: Drag, vertex: Vertex | undefined): void {
    if (this.#drag === drag) this.#drag = undefined;
    if (vertex) this.#put({ grip: drag.grip, vertex });
    else this.#host.show();
  }

  #put(drag: Drag): void {
    const of = this.#measurementOf(drag.grip);
    if (of && drag.vertex) this.#host.reshape(of.id, dragged(of.vertices, drag));
  }

  /** @throws MeasureError MEASURE_VERTICES where the figure has no more than it needs */
  async #takeOut({ id, vertices }: Measurement, vertex: number): Promise<void> {
    this.#host.reshape(id, vertices.toSpliced(vertex, 1));
  }

  #measurementOf({ id, vertex }: Grip): Measurement | undefined {
    return this.#host.measurements().find((one) => one.id === id && vertex < one.vertices.length);
  }

  #vertexOf(grip: Grip): Vertex | undefined {
    return grip.between ? undefined : this.#measurementOf(grip)?.vertices[grip.vertex];
  }
}
