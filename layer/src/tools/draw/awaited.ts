import type { Measurement } from "../measure/index.js";

/** A figure that somebody waits for. */
export class Awaited {
  /** Of the measurement that it becomes. */
  readonly id = crypto.randomUUID();
  readonly done: Promise<Measurement | undefined>;
  /** Ends the waiting; undefined where the reader gave it up. */
  readonly resolve: (measurement: Measurement | undefined) => void;

  /** @param givenUp called once the signal is aborted, after which `done` rejects with its reason */
  constructor(signal: AbortSignal | undefined, givenUp: () => void) {
    let [resolve, reject]: [typeof this.resolve, (reason: unknown) => void] = [
      () => undefined,
      () => undefined,
    ];
    this.done = new Promise((resolved, rejected) => {
      [resolve, reject] = [resolved, rejected];
    });
    const stop = () => {
      // First: giving the figure up would resolve it.
      reject(signal!.reason);
      givenUp();
    };
    signal?.addEventListener("abort", stop);
    this.resolve = (measurement) => {
      signal?.removeEventListener("abort", stop);
      resolve(measurement);
    };
  }
}
