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
    await nextTurn();
    this.#signal?.throwIfAborted();
    this.#began = performance.now();
  }
}

/** What Node has and pages have not. */
const { setImmediate } = globalThis as { readonly setImmediate?: (work: () => void) => void };

/** Those who wait for their next turn, in a page. */
const waiting: (() => void)[] = [];
let channel: MessageChannel | undefined;

/**
 * Comes after whoever waits for the thread by now, and no later: a timer would let it lie idle for a millisecond in Node,
 * and for four in a page, as long as the task ran before.
 */
export function nextTurn(): Promise<void> {
  return new Promise((resolve) => {
    if (setImmediate) {
      setImmediate(resolve);
      return;
    }
    if (!channel) {
      channel = new MessageChannel();
      channel.port1.onmessage = () => waiting.shift()?.();
    }
    waiting.push(resolve);
    channel.port2.postMessage(undefined);
  });
}
