import type { StreamProgress } from "../cloud/index.js";
import { restsOn } from "./still-frame.js";

const NOTHING: StreamProgress = { wanted: 0, ready: 0, failed: 0, pending: 0 };

/** What a frame came to. */
export interface FrameOutcome {
  /** How far what the view wants is here. */
  readonly progress: StreamProgress;
  /** Nodes that are here and not in the picture yet. */
  readonly undrawn: number;
  /** Whether all that is here is drawn as it is asked for. */
  readonly drawn: boolean;
  /** Whether nothing is on its way. */
  readonly idle: boolean;
  /** Where the camera is and looks now, in a form that can be compared; asked again by {@link Completion.settled}. */
  readonly pose: () => readonly number[];
}

/** What a frame changed. */
export interface FrameChange {
  /** Whether the numbers changed. */
  readonly changed: boolean;
  /** Whether it is the first to show all that its view wants, without any failure. */
  readonly finished: boolean;
  /** Whether a further frame would show no more. */
  readonly done: boolean;
}

/** How far a layer has come with what its view wants. */
export class Completion {
  #progress = NOTHING;
  #complete = false;
  #settled = false;
  /** `show` as the last frame found it. */
  #shown: boolean | undefined;
  #poseNow: (() => readonly number[]) | undefined;
  #pose: readonly number[] = [];

  /** How far what the view wants is in the picture: a node that is here and not drawn is still pending. */
  get progress(): StreamProgress {
    return this.#progress;
  }

  /** Takes note of a frame. */
  note({ progress: here, undrawn, drawn, idle, pose }: FrameOutcome): FrameChange {
    const late = Math.min(undrawn, here.ready);
    const progress = { ...here, ready: here.ready - late, pending: here.pending + late };
    const changed = !sameProgress(progress, this.#progress);
    const done = progress.pending === 0 && drawn;
    const complete = done && progress.failed === 0 && idle;
    const finished = complete && !this.#complete;
    this.#progress = progress;
    this.#complete = complete;
    this.#settled = done;
    this.#shown = true;
    this.#poseNow = pose;
    this.#pose = pose();
    return { changed, finished, done };
  }

  /** Nothing is drawn. Where nothing is to be drawn, nothing is to be waited for. */
  rest(show: boolean): void {
    this.#shown = show;
    this.#progress = NOTHING;
    this.#complete = false;
    this.#settled = true;
    this.#poseNow = undefined;
  }

  /** Whether the last frame showed all that can be had of what it was to show, and its camera stands where it stood. */
  settled(show: boolean): boolean {
    const moved = this.#poseNow !== undefined && !restsOn(this.#poseNow(), this.#pose);
    return this.#settled && this.#shown === show && !moved;
  }
}

function sameProgress(a: StreamProgress, b: StreamProgress): boolean {
  const sameNumbers = a.wanted === b.wanted && a.ready === b.ready && a.failed === b.failed;
  return sameNumbers && a.pending === b.pending && a.waiting === b.waiting;
}
