/** A binary heap of numbers: the one with the greatest priority comes out first. It makes nothing but when it grows. */
export class PriorityQueue {
  #items = new Int32Array(1024);
  #priorities = new Float64Array(1024);
  #length = 0;

  /** @param item a whole number of 32 bits */
  push(item: number, priority: number): void {
    if (this.#length === this.#items.length) this.#grow();
    const items = this.#items;
    const priorities = this.#priorities;
    let at = this.#length++;
    // Those of lesser priority move down into the gap until the item's place is found.
    while (at > 0) {
      const parent = (at - 1) >> 1;
      if (priorities[parent] >= priority) break;
      items[at] = items[parent];
      priorities[at] = priorities[parent];
      at = parent;
    }
    items[at] = item;
    priorities[at] = priority;
  }

  /** Takes out the item with the greatest priority; undefined where there is none. */
  pop(): number | undefined {
    if (this.#length === 0) return undefined;
    const top = this.#items[0];
    const last = --this.#length;
    if (last > 0) this.#sink(this.#items[last], this.#priorities[last]);
    return top;
  }

  /** Takes out all. */
  clear(): void {
    this.#length = 0;
  }

  /** Puts an item in the gap at the top, and moves that down to where the item belongs. */
  #sink(item: number, priority: number): void {
    const items = this.#items;
    const priorities = this.#priorities;
    const count = this.#length;
    let at = 0;
    for (;;) {
      let child = 2 * at + 1;
      if (child >= count) break;
      if (child + 1 < count && priorities[child + 1] > priorities[child]) child++;
      if (priorities[child] <= priority) break;
      items[at] = items[child];
      priorities[at] = priorities[child];
      at = child;
    }
    items[at] = item;
    priorities[at] = priority;
  }

  #grow(): void {
    const items = new Int32Array(2 * this.#length);
    items.set(this.#items);
    this.#items = items;
    const priorities = new Float64Array(2 * this.#length);
    priorities.set(this.#priorities);
    this.#priorities = priorities;
  }
}
