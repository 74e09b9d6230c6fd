/** Milliseconds of a frame that may go into preparing what is new: half of what a frame of 120 per second has. */
const MILLISECONDS = 4;
/** Where frames take long anyway, the share of their time that may go into it. */
const SHARE = 1 / 4;
/** Milliseconds that it takes at most, however long frames are, once there is a picture. */
const MOST = 25;

/**
 * The time that a frame may spend on preparing what is new, shared by all that prepares: programs, volumes, uploads.
 * What it does not reach waits for the frames to come, and what was shown before stays meanwhile.
 */
export class FrameAllowance {
  readonly #clock: () => number;
  readonly #milliseconds: number;
  readonly #end: number;
  #granted = false;

  /**
   * Begins a frame.
   * @param clock milliseconds
   */
  constructor(clock: () => number = () => performance.now(), milliseconds = MILLISECONDS) {
    this.#clock = clock;
    this.#milliseconds = milliseconds;
    this.#end = clock() + milliseconds;
  }

  /**
   * Begins a frame that follows one of so many milliseconds: otherwise a slow machine would prepare only one step per
   * frame.
   * @param shown whether there is a picture, which is to move smoothly
   */
  static after(frame: number, shown: boolean): FrameAllowance {
    const most = shown ? MOST : Number.POSITIVE_INFINITY;
    return new FrameAllowance(undefined, Math.min(most, Math.max(MILLISECONDS, SHARE * frame)));
  }

  /** The allowance of the frame's last part, which has at least half of the time however long the others took. */
  last(): FrameAllowance {
    const left = this.#end - this.#clock();
    return new FrameAllowance(this.#clock, Math.max(left, this.#milliseconds / 2));
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
