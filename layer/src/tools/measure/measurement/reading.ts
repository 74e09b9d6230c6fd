import { isAbort } from "../../../errors/index.js";
import type { Measurement, NamedValue } from "./measurement.js";
import { type ReadValuesOptions, readsPoints, readValues } from "./read-values.js";

/** How far the reading of a measurement's values is. */
export type Reading =
  | { readonly state: "reading"; readonly share: number }
  | { readonly state: "done"; readonly values: readonly NamedValue[] }
  | { readonly state: "failed"; readonly thrown: unknown }
  | { readonly state: "stopped" };

/** What is asked for, without what a single one of them has. */
export type ReadingOptions = Omit<ReadValuesOptions, "signal" | "onProgress">;

/** Reads values of measurements, one after the other, and keeps them as long as the measurement is the same. */
export class Readings {
  readonly #changed: () => void;
  readonly #options: () => ReadingOptions;
  #known = new WeakMap<Measurement, Reading>();
  #waiting: Measurement[] = [];
  #running: { readonly of: Measurement; readonly stop: AbortController } | undefined;

  /**
   * @param options asked for anew with each measurement
   * @param changed told whenever a reading goes on
   */
  constructor(options: () => ReadingOptions, changed: () => void) {
    this.#options = options;
    this.#changed = changed;
  }

  /** Undefined where nothing of it takes reading, or nobody has asked for it. */
  of(measurement: Measurement): Reading | undefined {
    return this.#known.get(measurement);
  }

  /** Reads what is not yet read of these, and gives up what is not among them. */
  follow(measurements: readonly Measurement[]): void {
    const wanted = new Set(measurements);
    for (const one of this.#waiting) if (!wanted.has(one)) this.#known.delete(one);
    this.#waiting = this.#waiting.filter((one) => wanted.has(one));
    if (this.#running && !wanted.has(this.#running.of)) {
      this.#known.delete(this.#running.of);
      this.#running.stop.abort();
    }
    for (const one of measurements) {
      if (!readsPoints(one) || this.#known.has(one)) continue;
      this.#known.set(one, { state: "reading", share: 0 });
      this.#waiting.push(one);
    }
    this.#next();
  }

  /** Gives up reading the values of a measurement; `again` reads them after all. */
  stop(measurement: Measurement): void {
    if (this.#known.get(measurement)?.state !== "reading") return;
    this.#known.set(measurement, { state: "stopped" });
    this.#waiting = this.#waiting.filter((one) => one !== measurement);
    if (this.#running?.of === measurement) this.#running.stop.abort();
    this.#changed();
  }

  /** Reads anew, whatever was known. */
  again(measurements: readonly Measurement[]): void {
    for (const one of measurements) this.#known.delete(one);
    this.#waiting = this.#waiting.filter((one) => !measurements.includes(one));
    if (this.#running && measurements.includes(this.#running.of)) this.#running.stop.abort();
    this.follow(measurements);
  }

  destroy(): void {
    this.follow([]);
  }

  #next(): void {
    if (this.#running) return;
    const of = this.#waiting.shift();
    if (!of) return;
    const stop = new AbortController();
    const running = { of, stop };
    this.#running = running;
    const { signal } = stop;
    const told = (reading: Reading) => {
      if (signal.aborted) return;
      this.#known.set(of, reading);
      this.#changed();
    };
    const options = { ...this.#options(), signal, onProgress: progress(told) };
    readValues(of, options)
      .then((values) => told({ state: "done", values }))
      .catch((thrown: unknown) => told(isAbort(thrown) ? { state: "stopped" } : { state: "failed", thrown }))
      .finally(() => {
        if (this.#running === running) this.#running = undefined;
        this.#next();
      });
  }
}

/** Tells of each percent once: figures are drawn anew with it. */
function progress(told: (reading: Reading) => void): (share: number) => void {
  let last = 0;
  return (share) => {
    if (share < last + 0.01) return;
    last = share;
    told({ state: "reading", share });
  };
}
