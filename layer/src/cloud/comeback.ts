import type { SourceError } from "../errors/index.js";
import type { OctreeNode } from "../octree/index.js";
import type { ServerWait } from "../sources/contract/point-source.js";

/** What is known of a node that is temporarily unavailable. */
interface Missing {
  readonly fault: SourceError;
  /** Failures so far. */
  readonly failures: number;
  /** Of these, such that others came from the server in between: it serves, but not this node. */
  readonly strikes: number;
  /** How many nodes had come when it failed last. */
  readonly arrivals: number;
  /** `Date.now()` at which it is asked for again; undefined: it has been asked for. */
  due: number | undefined;
}

/** Milliseconds before a node is asked for again, doubled with each failure, and at most. */
const FIRST_PAUSE = 1_000;
const LONGEST_PAUSE = 60_000;

/** Strikes after which a node counts as failed for good. */
const STRIKES = 4;

/**
 * When nodes are asked for again that a server could not give for now. Pauses grow with each failure of a node; those
 * that failed with the whole server are due as soon as something comes from it.
 */
export class Comeback {
  readonly #missing = new Map<OctreeNode, Missing>();
  readonly #ask: (node: OctreeNode) => boolean;
  #arrivals = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #wait: ServerWait | undefined;

  /** @param ask asks for a node that is due; false where nobody wants it any more */
  constructor(ask: (node: OctreeNode) => boolean) {
    this.#ask = ask;
  }

  /** Why the nodes are waited for, and until when for the first of them; undefined: there is none. */
  get wait(): ServerWait | undefined {
    return this.#wait;
  }

  /** Whether a node waits to be asked for again. */
  has(node: OctreeNode): boolean {
    return this.#missing.get(node)?.due !== undefined;
  }

  /**
   * A node is temporarily unavailable.
   * @param earliest `Date.now()` before which its server is not to be asked
   * @returns false where it has failed too often while its server served others: it is given up
   */
  add(node: OctreeNode, fault: SourceError, earliest = 0): boolean {
    const before = this.#missing.get(node);
    const served = before !== undefined && this.#arrivals > before.arrivals;
    const strikes = (before?.strikes ?? 0) + (served ? 1 : 0);
    if (strikes >= STRIKES) {
      this.forget(node);
      return false;
    }
    const failures = (before?.failures ?? 0) + 1;
    const pause = Math.min(FIRST_PAUSE * 2 ** (failures - 1), LONGEST_PAUSE) * (0.75 + 0.5 * Math.random());
    const due = Math.max(Date.now() + pause, earliest);
    this.#missing.set(node, { fault, failures, strikes, arrivals: this.#arrivals, due });
    this.#plan();
    return true;
  }

  /** A node is here: its server serves again. */
  arrived(node: OctreeNode): void {
    this.#arrivals++;
    if (this.#missing.size === 0) return;
    this.#missing.delete(node);
    this.#hasten(({ strikes }) => strikes === 0);
  }

  /** A node is no longer asked for. */
  forget(node: OctreeNode): void {
    if (this.#missing.delete(node)) this.#plan();
  }

  /** Has all that is missing asked for now. */
  hasten(): void {
    this.#hasten(() => true);
  }

  /** Gives up all. */
  clear(): void {
    this.#missing.clear();
    this.#plan();
  }

  #hasten(which: (missing: Missing) => boolean): void {
    for (const missing of this.#missing.values()) {
      if (missing.due !== undefined && which(missing)) missing.due = 0;
    }
    this.#plan();
  }

  /** Sets the clock for what is due next. */
  #plan(): void {
    clearTimeout(this.#timer);
    let next: Missing | undefined;
    for (const missing of this.#missing.values()) {
      if (missing.due !== undefined && !(next?.due !== undefined && next.due <= missing.due)) next = missing;
    }
    this.#wait = next && waitFor(next);
    if (next?.due !== undefined) this.#timer = setTimeout(() => this.#askDue(), next.due - Date.now());
  }

  #askDue(): void {
    const now = Date.now();
    for (const [node, missing] of this.#missing) {
      if (missing.due === undefined || missing.due > now) continue;
      missing.due = undefined;
      if (!this.#ask(node)) this.#missing.delete(node);
    }
    this.#plan();
  }
}

function waitFor({ fault: { outage = "failing", code, cause }, due }: Missing): ServerWait {
  return { outage, code, cause, until: due };
}
