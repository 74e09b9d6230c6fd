/** An answer may take this many times as long as the longest silence. */
const WHOLE = 12;

/** Ends a request that stays silent for too long, or that drags on. */
export class SilenceWatch {
  readonly #controller = new AbortController();
  readonly #limit: number;
  readonly #tell: () => void;
  readonly #whole: ReturnType<typeof setTimeout>;
  #telling: ReturnType<typeof setTimeout> | undefined;
  #ending: ReturnType<typeof setTimeout> | undefined;

  /**
   * @param limit longest silence, milliseconds
   * @param tell called once a third of it has passed
   */
  constructor(limit: number, tell: () => void) {
    this.#limit = limit;
    this.#tell = tell;
    this.#whole = setTimeout(() => this.#controller.abort("slow"), WHOLE * limit);
    this.heard();
  }

  /** Aborted when it was too long, with the reason `"silent"` or `"slow"`. */
  get signal(): AbortSignal {
    return this.#controller.signal;
  }

  /** Something came. */
  heard(): void {
    clearTimeout(this.#telling);
    clearTimeout(this.#ending);
    this.#telling = setTimeout(this.#tell, this.#limit / 3);
    this.#ending = setTimeout(() => this.#controller.abort("silent"), this.#limit);
  }

  /** The request has ended. */
  stop(): void {
    for (const timer of [this.#whole, this.#telling, this.#ending]) clearTimeout(timer);
  }
}
