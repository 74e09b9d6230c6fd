/** A binary heap: the item with the greatest priority comes out first. */
export class PriorityQueue<T> {
  readonly #items: T[] = [];
  readonly #priorities: number[] = [];

  get size(): number {
    return this.#items.length;
  }

  push(item: T, priority: number): void {
    let at = this.#items.length;
    this.#items.push(item);
    this.#priorities.push(priority);
    while (at > 0) {
      const parent = (at - 1) >> 1;
      if (this.#priorities[parent] >= priority) break;
      this.#swap(at, parent);
      at = parent;
    }
  }

  /** Takes out the item with the greatest priority; undefined where there is none. */
  pop(): T | undefined {
    const top = this.#items[0];
    const last = this.#items.pop();
    const priority = this.#priorities.pop();
    if (this.#items.length === 0 || last === undefined || priority === undefined) return top;
    this.#items[0] = last;
    this.#priorities[0] = priority;
    this.#sink();
    return top;
  }

  #sink(): void {
    const count = this.#items.length;
    let at = 0;
    for (;;) {
      const left = 2 * at + 1;
      let greatest = at;
      if (left < count && this.#priorities[left] > this.#priorities[greatest]) greatest = left;
      if (left + 1 < count && this.#priorities[left + 1] > this.#priorities[greatest]) greatest = left + 1;
      if (greatest === at) return;
      this.#swap(at, greatest);
      at = greatest;
    }
  }

  #swap(a: number, b: number): void {
    [this.#items[a], this.#items[b]] = [this.#items[b], this.#items[a]];
    [this.#priorities[a], this.#priorities[b]] = [this.#priorities[b], this.#priorities[a]];
  }
}
