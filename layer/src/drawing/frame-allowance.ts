/** Milliseconds of a frame that may go into preparing what is new: half of what a frame of 120 per second has. */
const MILLISECONDS = 4;

/**
 * The time that a frame may spend on preparing what is new, shared by all that prepares: programs, volumes, uploads.
 * What it does not reach waits for the frames to come, and what was shown before stays meanwhile.
 */
export class FrameAllowance {
  readonly #clock: () => number;
  readonly #end: number;
  #granted = false;

  /**
   * Begins a frame.
   * @param clock milliseconds
   */
  constructor(clock: () => number = () => performance.now(), milliseconds = MILLISECONDS) {
    this.#clock = clock;
    this.#end = clock() + milliseconds;
  }

  /** Whether there is time left. */
  get left(): boolean {
    return this.#clock() < this.#end;
  }

  /** Asks for one step. The first of a frame is always granted, so that all is done in the end on any machine. */
  grants(): boolean {
    const granted = !this.#granted || this.left;
    this.#granted = true;
    return granted;
  }
}
