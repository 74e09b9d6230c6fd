/** What an item takes up. */
export interface Cost {
  readonly points: number;
  readonly bytes: number;
}

/** How much may be held. */
export interface CacheLimits extends Cost {
  /** Share of the limits down to which a trim goes on. Below 1, so that not every new item evicts one. Default: 0.8. */
  readonly low?: number;
}

/** What was used last is kept; what was not used for longest goes first once a limit is passed. */
export class LruCache<K, V> {
  limits: CacheLimits;
  // A Map keeps the order of insertion: the first entry is the one not used for longest.
  readonly #entries = new Map<K, { value: V; cost: Cost }>();
  #points = 0;
  #bytes = 0;

  constructor(limits: CacheLimits) {
    this.limits = limits;
  }

  /** Points held. */
  get points(): number {
    return this.#points;
  }

  /** Bytes held. */
  get bytes(): number {
    return this.#bytes;
  }

  /** Value of a key, without counting as a use. */
  peek(key: K): V | undefined {
    return this.#entries.get(key)?.value;
  }

  /** Value of a key, which is thereby the one used last. */
  use(key: K): V | undefined {
    const entry = this.#entries.get(key);
    if (!entry) return undefined;
    this.#entries.delete(key);
    this.#entries.set(key, entry);
    return entry.value;
  }

  /** All values, without counting as a use. */
  *values(): Generator<V> {
    for (const { value } of this.#entries.values()) yield value;
  }

  /** Puts in a value, or another one for a key. */
  set(key: K, value: V, cost: Cost): void {
    this.delete(key);
    this.#entries.set(key, { value, cost });
    this.#points += cost.points;
    this.#bytes += cost.bytes;
  }

  delete(key: K): boolean {
    const entry = this.#entries.get(key);
    if (!entry) return false;
    this.#entries.delete(key);
    this.#points -= entry.cost.points;
    this.#bytes -= entry.cost.bytes;
    return true;
  }

  /**
   * Where a limit is passed, takes out what was not used for longest and is not in use, until the low mark.
   * @param excess bytes that are to go whatever the own limits are
   * @returns what was taken out
   */
  trim(inUse: (key: K) => boolean, excess = 0): [K, V][] {
    const { points, bytes, low = 0.8 } = this.limits;
    const removed: [K, V][] = [];
    if (this.#points <= points && this.#bytes <= bytes && excess <= 0) return removed;
    const passed = this.#points > points || this.#bytes > bytes;
    const most = Math.min(passed ? bytes * low : bytes, excess > 0 ? this.#bytes - excess : Infinity);
    for (const [key, { value }] of this.#entries) {
      if (this.#points <= (passed ? points * low : points) && this.#bytes <= most) break;
      if (inUse(key)) continue;
      this.delete(key);
      removed.push([key, value]);
    }
    return removed;
  }
}
