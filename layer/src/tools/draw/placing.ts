import type { Measurement, Vertex } from "../measure/index.js";
import type { Draft } from "./history.js";
import type { ScreenPoint, ViewAdapter } from "./view-adapter.js";

/** Pixels around a place in which a point counts, and in which a vertex that is there is taken instead. */
const REACH = 7;
const SNAP = 9;

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
   * @param others vertices that may be taken as they are
   */
  async place(
    at: ScreenPoint,
    others: readonly Vertex[],
    work: (vertex: Vertex | undefined) => void,
  ): Promise<void> {
    const before = this.#turns.last;
    const found = this.#find(at, others);
    const done = Promise.all([found, before.catch(() => undefined)]).then(([vertex]) => {
      if (!this.#signal.aborted) work(vertex);
    });
    this.#turns.last = done;
    await done;
  }

  /** The vertex at a place, for show; nothing while one is looked for already. */
  async look(at: ScreenPoint, others: readonly Vertex[]): Promise<Vertex | undefined> {
    if (this.#looking) return undefined;
    this.#looking = true;
    try {
      return await this.#find(at, others);
    } finally {
      this.#looking = false;
    }
  }

  async #find(at: ScreenPoint, others: readonly Vertex[]): Promise<Vertex | undefined> {
    return this.#nearest(at, others) ?? (await this.#view.pick(at, REACH, this.#signal));
  }

  #nearest(at: ScreenPoint, others: readonly Vertex[]): Vertex | undefined {
    let nearest: Vertex | undefined;
    let least = SNAP;
    for (const vertex of others) {
      const place = this.#view.project(vertex);
      const apart = place ? Math.hypot(place.x - at.x, place.y - at.y) : Number.POSITIVE_INFINITY;
      if (apart <= least) [nearest, least] = [vertex, apart];
    }
    return nearest;
  }
}

/** All vertices that a new one may snap to. */
export function verticesOf(measurements: readonly Measurement[], draft: Draft | undefined): Vertex[] {
  return [...(draft?.vertices ?? []), ...measurements.flatMap(({ vertices }) => vertices)];
}

/** Whether two vertices are one: the same record, or the same place where they are none. */
export function isSame(a: Vertex, b: Vertex): boolean {
  if (a.record && b.record) {
    const [one, other] = [a.record, b.record];
    return one.dataset === other.dataset && one.node === other.node && one.index === other.index;
  }
  return a.ecef.every((value, axis) => value === b.ecef[axis]);
}
