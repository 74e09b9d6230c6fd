import type { Vertex } from "../measure/index.js";
import { nearestOnEdge, nearestVertex, type Snaps } from "./snapping.js";
import type { ScreenPoint, ViewAdapter } from "./view-adapter.js";

/** Pixels around a place in which a point counts. */
const REACH = 7;

/** The order in which vertices were asked for, on whatever view. */
export interface Turns {
  last: Promise<unknown>;
}

/** Finds the vertices for places of a view, one after the other. */
export class Placing {
  readonly #view: ViewAdapter;
  readonly #turns: Turns;
  readonly #signal: AbortSignal;
  #looking = false;

  constructor(view: ViewAdapter, turns: Turns, signal: AbortSignal) {
    this.#view = view;
    this.#turns = turns;
    this.#signal = signal;
  }

  /**
   * Does work with the vertex at a place, once all that was asked for before is done: clicks keep their order, however
   * long a record takes to be read.
   * @param snaps vertices that are taken before points, edges where there is no point
   */
  async place(at: ScreenPoint, snaps: Snaps, work: (vertex: Vertex | undefined) => void): Promise<void> {
    const before = this.#turns.last;
    const found = this.#find(at, snaps);
    const done = Promise.all([found, before.catch(() => undefined)]).then(([vertex]) => {
      if (!this.#signal.aborted) work(vertex);
    });
    this.#turns.last = done;
    await done;
  }

  /** The vertex at a place, for show; nothing while one is looked for already. */
  async look(at: ScreenPoint, snaps: Snaps): Promise<Vertex | undefined> {
    if (this.#looking) return undefined;
    this.#looking = true;
    try {
      return await this.#find(at, snaps);
    } finally {
      this.#looking = false;
    }
  }

  async #find(at: ScreenPoint, snaps: Snaps): Promise<Vertex | undefined> {
    return (
      nearestVertex(this.#view, at, snaps) ??
      (await this.#view.pick(at, REACH, this.#signal)) ??
      nearestOnEdge(this.#view, at, snaps)
    );
  }
}
