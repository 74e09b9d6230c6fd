import { LruCache } from "../octree/index.js";

/** Something that is being read, and how many wait for it. */
interface Reading<T> {
  readonly promise: Promise<T>;
  readonly controller: AbortController;
  waiting: number;
}

/**
 * Reads that several octrees of one data set make: what one has read, or is reading, is not asked for again by another.
 * What was read is kept up to a number of bytes, and goes by the time that it was last asked for.
 */
export class SharedReads<T> {
  readonly #kept: LruCache<unknown, T>;
  readonly #bytesOf: (value: T) => number;
  readonly #underWay = new Map<unknown, Reading<T>>();

  /** @param bytes that are kept at most */
  constructor(bytes: number, bytesOf: (value: T) => number) {
    this.#kept = new LruCache<unknown, T>({ points: Number.POSITIVE_INFINITY, bytes });
    this.#bytesOf = bytesOf;
  }

  /**
   * What stands under a key, read where it is not here. A read is stopped once nobody waits for it any more.
   * @throws what the read throws; the signal's reason when aborted
   */
  async read(
    key: unknown,
    signal: AbortSignal | undefined,
    start: (signal: AbortSignal) => Promise<T>,
  ): Promise<T> {
    signal?.throwIfAborted();
    const kept = this.#kept.use(key);
    if (kept !== undefined) return kept;
    const reading = this.#underWay.get(key) ?? this.#begin(key, start);
    reading.waiting++;
    try {
      return await (signal ? unlessAborted(reading.promise, signal) : reading.promise);
    } finally {
      reading.waiting--;
      if (reading.waiting === 0 && this.#underWay.get(key) === reading) {
        this.#underWay.delete(key);
        reading.controller.abort(signal?.reason);
      }
    }
  }

  /** Reads what stands under a key again when it is next asked for: it was found to be damaged. */
  forget(key: unknown): void {
    this.#kept.delete(key);
  }

  /** Keeps so many bytes at most from now on. */
  limit(bytes: number): void {
    this.#kept.limits = { points: Number.POSITIVE_INFINITY, bytes };
    this.#kept.trim(() => false);
  }

  #begin(key: unknown, start: (signal: AbortSignal) => Promise<T>): Reading<T> {
    const controller = new AbortController();
    const promise = this.#carryOut(key, controller.signal, start);
    const reading = { promise, controller, waiting: 0 };
    this.#underWay.set(key, reading);
    const end = () => {
      if (this.#underWay.get(key) === reading) this.#underWay.delete(key);
    };
    promise.then(end, end);
    return reading;
  }

  async #carryOut(key: unknown, signal: AbortSignal, start: (signal: AbortSignal) => Promise<T>): Promise<T> {
    const value = await start(signal);
    this.#kept.set(key, value, { points: 0, bytes: this.#bytesOf(value) });
    this.#kept.trim(() => false);
    return value;
  }
}

/** The promise's outcome, or the signal's reason as soon as it is aborted. */
export function unlessAborted<T>(promise: Promise<T>, signal: AbortSignal): Promise<T> {
  return new Promise((resolve, reject) => {
    const stop = () => reject(signal.reason);
    signal.addEventListener("abort", stop, { once: true });
    promise.then(resolve, reject).finally(() => signal.removeEventListener("abort", stop));
  });
}

/** Items that come one by one and can be gone through any number of times, up to the error that ends them. */
export class Replay<T> implements Iterable<T> {
  readonly #taken: T[] = [];
  readonly #rest: Iterator<T>;
  readonly #failed: () => void;
  #failure: { readonly thrown: unknown } | undefined;

  /** @param failed called with the error */
  constructor(items: Iterable<T>, failed: () => void) {
    this.#failed = failed;
    this.#rest = items[Symbol.iterator]();
  }

  *[Symbol.iterator](): Generator<T, void> {
    for (let at = 0; ; at++) {
      if (at === this.#taken.length) {
        const { done, value } = this.#next();
        if (done) return;
        this.#taken.push(value);
      }
      yield this.#taken[at];
    }
  }

  /** A generator that has thrown says that it is done when it is asked again. */
  #next(): IteratorResult<T> {
    if (this.#failure) throw this.#failure.thrown;
    try {
      return this.#rest.next();
    } catch (thrown) {
      this.#failure = { thrown };
      this.#failed();
      throw thrown;
    }
  }
}
