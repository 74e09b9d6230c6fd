/** A binary heap: the item with the greatest priority comes out first. */
export class PriorityQueue<T> {
  readonly #items: T[] = [];
  readonly #priorities: number[] = [];

  push(item: T, priority: number): void {
    const items = this.#items;
    const priorities = this.#priorities;
    let at = items.length;
    items.push(item);
    priorities.push(priority);
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
  pop(): T | undefined {
    const top = this.#items[0];
    const last = this.#items.pop();
    const priority = this.#priorities.pop();
    if (this.#items.length === 0 || last === undefined || priority === undefined) return top;
    this.#sink(last, priority);
    return top;
  }

  /** Puts an item in the gap at the top, and moves that down to where the item belongs. */
  #sink(item: T, priority: number): void {
    const items = this.#items;
    const priorities = this.#priorities;
    const count = items.length;
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
}
