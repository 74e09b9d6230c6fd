/** Milliseconds of the thread that a long task takes at a time: half of what a frame of 120 per second has. */
const STRETCH = 4;

/** Lets a long task go on in stretches, so that frames and input come in between. */
export class Pace {
  readonly #signal: AbortSignal | undefined;
  #began = performance.now();

  constructor(signal: AbortSignal | undefined) {
    this.#signal = signal;
  }

  /** Gives the thread back once the task has had it for long enough. @throws the signal's reason when aborted */
  async rest(): Promise<void> {
    if (performance.now() - this.#began < STRETCH) return;
    await new Promise((resolve) => setTimeout(resolve));
    this.#signal?.throwIfAborted();
    this.#began = performance.now();
  }
}
