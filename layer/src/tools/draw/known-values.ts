import { type Measurement, type NamedValue, valuesOf, type WorthOptions } from "../measure/index.js";

/** What a measurement comes to, or why it comes to nothing. */
type Known = { readonly values: readonly NamedValue[] } | { readonly thrown: unknown };

/**
 * Values of measurements, worked out once for each: labels and lists ask for them whenever anything changes, and figures of many
 * vertices take milliseconds.
 */
export class KnownValues {
  #worth: WorthOptions;
  #known = new WeakMap<Measurement, Known>();

  constructor(worth: WorthOptions) {
    this.#worth = worth;
  }

  get worth(): WorthOptions {
    return this.#worth;
  }

  set worth(worth: WorthOptions) {
    this.#worth = worth;
    this.#known = new WeakMap();
  }

  /** @throws MeasureError where its vertices have no such value */
  of(measurement: Measurement): readonly NamedValue[] {
    let known = this.#known.get(measurement);
    if (!known) {
      known = this.#workedOut(measurement);
      this.#known.set(measurement, known);
    }
    if ("thrown" in known) throw known.thrown;
    return known.values;
  }

  #workedOut(measurement: Measurement): Known {
    try {
      return { values: valuesOf(measurement, this.#worth) };
    } catch (thrown) {
      return { thrown };
    }
  }
}
