/** A node as far as its place among others hangs on it. */
interface Orderable {
  readonly uploaded: {
    /** Number of the page that it lies in. */
    readonly page: number;
  };
}

/** Binary digits of a number of steps of distance that are told apart. */
const DIGITS = 10;

/**
 * The order in which the nodes of a frame are drawn: those of one page follow each other, so that one call draws them. Within a
 * page the nearest come first, and the page that has the nearest of all does: what lies behind others then fails the depth test,
 * and is not shaded. In each frame of a view that moves, so that its arrays serve all frames.
 */
export class DrawOrder {
  #keys = new Float32Array(0);
  /** The bits of the keys, which rise with the logarithm of a positive number. */
  #bits = new Int32Array(0);
  #indices = new Int32Array(0);
  #pageOf = new Int32Array(0);
  readonly #steps = new Int32Array(2 ** DIGITS + 1);
  /** Of each page its nodes, then the index of the next one of them. */
  readonly #pages: number[] = [];
  readonly #next: number[] = [];

  /**
   * @param nearest of the nodes, how far away they begin, above 0, metres; undefined: they stay as they come
   * @returns the nodes in another array
   */
  of<Node extends Orderable>(nodes: readonly Node[], nearest: ArrayLike<number> | undefined): Node[] {
    this.#reserve(nodes.length);
    this.#byDistance(nodes.length, nearest);
    const indices = this.#indices;
    const pageOf = this.#pageOf;
    const pages = this.#pages;
    const next = this.#next;
    pages.length = 0;
    for (let index = 0; index < nodes.length; index++) {
      const { page } = nodes[index].uploaded;
      pageOf[index] = page;
      while (pages.length <= page) next[pages.push(0) - 1] = -1;
      pages[page]++;
    }
    let begin = 0;
    const ordered = nodes.slice();
    for (let at = 0; at < nodes.length; at++) {
      const index = indices[at];
      const page = pageOf[index];
      if (next[page] < 0) {
        next[page] = begin;
        begin += pages[page];
      }
      ordered[next[page]++] = nodes[index];
    }
    return ordered;
  }

  /** Counts nodes by steps of the logarithm of their distance, and leaves their indices in that order. */
  #byDistance(count: number, nearest: ArrayLike<number> | undefined): void {
    const keys = this.#keys;
    const bits = this.#bits;
    const indices = this.#indices;
    for (let index = 0; index < count; index++) keys[index] = nearest ? nearest[index] : 1;
    let least = Number.POSITIVE_INFINITY;
    let greatest = 0;
    for (let index = 0; index < count; index++) {
      least = Math.min(least, bits[index]);
      greatest = Math.max(greatest, bits[index]);
    }
    const shift = Math.max(0, 32 - Math.clz32(greatest - least) - DIGITS);
    const steps = this.#steps.fill(0);
    for (let index = 0; index < count; index++) steps[((bits[index] - least) >> shift) + 1]++;
    for (let step = 1; step < steps.length; step++) steps[step] += steps[step - 1];
    for (let index = 0; index < count; index++) indices[steps[(bits[index] - least) >> shift]++] = index;
  }

  #reserve(count: number): void {
    if (count <= this.#keys.length) return;
    this.#keys = new Float32Array(2 * count);
    this.#bits = new Int32Array(this.#keys.buffer);
    this.#indices = new Int32Array(2 * count);
    this.#pageOf = new Int32Array(2 * count);
  }
}
