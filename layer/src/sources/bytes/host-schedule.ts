import type { Outage, SourceError } from "../../errors/index.js";

/** Why nothing comes from a server for now, and when it is asked again. */
export interface ServerWait {
  readonly outage: Outage;
  /** Code of the error that it would be. */
  readonly code: string;
  /** What happened, in words. */
  readonly cause: string;
  /** When it is asked next, milliseconds since 1970; undefined: it has been asked and has not answered yet. */
  readonly until: number | undefined;
}

/** How a request went, told once; what is told after that is ignored. */
export interface Turn {
  /** Bytes have come. */
  heard(): void;
  /** No byte has come for a while, though the server was asked. */
  silent(fault: SourceError): void;
  /** The server has answered, be it with a refusal. */
  answered(): void;
  /**
   * The server could not do what it was asked for.
   * @param pause least pause before the next request, milliseconds: what it grows from, and what the server asked for
   */
  failed(fault: SourceError, pause: { readonly backoff: number; readonly asked: number | undefined }): void;
  /** The request was given up before it was answered. */
  left(): void;
}

interface Waiting {
  readonly deadline: number;
  readonly start: (turn: Turn) => void;
  readonly giveUp: () => void;
}

/** Longest pause between two requests to a server that fails, and longest that one may ask for; milliseconds. */
const LONGEST_PAUSE = 60_000;
const LONGEST_ASKED = 300_000;

/** Requests at once from which a server that was unwell counts as well again. */
const WELL = 16;

/**
 * When one server is asked, by whoever asks it. While it fails, one request at a time is let through, after pauses that
 * double up to a minute, or as long as the server asks for. Once it answers, two are let through, then four, and so on.
 */
export class HostSchedule {
  readonly #listeners = new Set<() => void>();
  /** In the order in which they came. */
  readonly #waiting = new Set<Waiting>();
  #wait: ServerWait | undefined;
  /** Requests that may run at once, and those that do. */
  #width = Number.POSITIVE_INFINITY;
  #active = 0;
  /** Failures in a row, those of requests that ran beside each other counted once. */
  #failures = 0;
  /** Grows with each failure: what began before it says nothing of how the server is after it. */
  #round = 0;
  #until = 0;
  /** Until when the server itself asked not to be asked. */
  #asked = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** The one schedule of all who ask the server of an address. */
  static of({ origin }: URL): HostSchedule {
    let schedule = schedules.get(origin);
    if (!schedule) {
      schedule = new HostSchedule();
      schedules.set(origin, schedule);
    }
    return schedule;
  }

  /** Why nothing comes; undefined while the server answers. */
  get wait(): ServerWait | undefined {
    return this.#wait;
  }

  /** Calls a function whenever {@link wait} changes. @returns ends that */
  subscribe(listener: () => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /**
   * Resolves once the server may be asked.
   * @param deadline `Date.now()` after which that is of no use
   * @returns undefined where the deadline would pass
   * @throws the signal's reason when aborted
   */
  enter(deadline: number, signal?: AbortSignal): Promise<Turn | undefined> {
    return new Promise((resolve, reject) => {
      const end = () => {
        this.#waiting.delete(waiting);
        signal?.removeEventListener("abort", stop);
      };
      const stop = () => {
        end();
        reject(signal?.reason);
      };
      const waiting: Waiting = {
        deadline,
        start: (turn) => {
          end();
          resolve(turn);
        },
        giveUp: () => {
          end();
          resolve(undefined);
        },
      };
      signal?.addEventListener("abort", stop, { once: true });
      this.#waiting.add(waiting);
      if (signal?.aborted) stop();
      else this.#next();
    });
  }

  /** Ends a pause that the server did not ask for: somebody wants to know whether it is back. */
  hasten(): void {
    this.#until = Math.min(this.#until, this.#asked);
    this.#next();
  }

  /** Lets through whom there is room for. */
  #next(): void {
    const pause = this.#until - Date.now();
    for (const waiting of this.#waiting) {
      if (waiting.deadline < this.#until) waiting.giveUp();
      else if (pause <= 0 && this.#active < this.#width) waiting.start(this.#begin());
    }
    clearTimeout(this.#timer);
    if (pause > 0 && this.#waiting.size > 0) this.#timer = setTimeout(() => this.#next(), pause);
  }

  #begin(): Turn {
    this.#active++;
    if (this.#wait?.until !== undefined) this.#say({ ...this.#wait, until: undefined });
    const round = this.#round;
    let over = false;
    const once = (act: () => void) => {
      if (over) return;
      over = true;
      this.#active--;
      act();
      this.#next();
    };
    return {
      heard: () => this.#endSilence(),
      silent: (fault) => {
        if (!over && !this.#wait) this.#say(waitFor(fault, undefined));
      },
      answered: () =>
        once(() => {
          if (round === this.#round) this.#mend();
        }),
      failed: (fault, { backoff, asked }) =>
        once(() => {
          if (round === this.#round) this.#failures++;
          this.#round++;
          this.#width = 1;
          const grown = Math.min(backoff * 2 ** (this.#failures - 1), LONGEST_PAUSE);
          // Those who share an outage must not come back all at once.
          const pause = grown * (0.75 + 0.5 * Math.random());
          if (asked !== undefined) this.#asked = Math.max(this.#asked, Date.now() + bounded(asked));
          this.#until = Math.max(this.#until, this.#asked, Date.now() + pause);
          this.#say(waitFor(fault, this.#until));
        }),
      left: () =>
        once(() => {
          if (this.#active === 0) this.#endSilence();
        }),
    };
  }

  #mend(): void {
    this.#failures = 0;
    this.#width = this.#width * 2 < WELL ? this.#width * 2 : Number.POSITIVE_INFINITY;
    this.#until = 0;
    this.#say(undefined);
  }

  #endSilence(): void {
    if (this.#wait?.outage === "silent" && this.#wait.until === undefined) this.#say(undefined);
  }

  #say(wait: ServerWait | undefined): void {
    if (!wait && !this.#wait) return;
    this.#wait = wait;
    for (const listener of this.#listeners) listener();
  }
}

/** By origin; as many as an application names. */
const schedules = new Map<string, HostSchedule>();

/** A pause that a server asks for, within bounds, and up to a tenth longer. */
function bounded(asked: number): number {
  return Math.min(asked, LONGEST_ASKED) * (1 + 0.1 * Math.random());
}

function waitFor({ code, cause, outage = "failing" }: SourceError, until: number | undefined): ServerWait {
  return { outage, code, cause, until };
}
