import type { AttributeSet } from "./vertex-attributes.js";

/** A node as far as it is drawn by a call. */
export interface ListedNode<VertexArray> {
  /** Its row in the table of nodes. */
  readonly row: number;
  /** Vertices that are drawn. */
  readonly count: number;
  readonly uploaded: {
    /** Its first vertex. */
    readonly first: number;
    arrayOf(reads: AttributeSet): VertexArray;
  };
}

/** Draws that one call can do: nodes that follow each other in their table and are read through the same vertex array. */
export interface DrawRun<VertexArray> {
  array: VertexArray;
  /** Row of the first node in the table. */
  row: number;
  /** Index of the first draw, and of the one after the last. */
  begin: number;
  end: number;
}

/** What a program draws of each of some nodes: vertices of pages, as WebGL takes them. Filled anew without making objects. */
export class DrawList<VertexArray> {
  #firsts = new Int32Array(64);
  #counts = new Int32Array(64);
  readonly #runs: DrawRun<VertexArray>[] = [];
  #length = 0;
  #used = 0;

  /** First vertex of each draw. */
  get firsts(): Int32Array {
    return this.#firsts;
  }

  /** Vertices of each draw. */
  get counts(): Int32Array {
    return this.#counts;
  }

  /** Number of {@link run}s. */
  get runs(): number {
    return this.#used;
  }

  run(index: number): DrawRun<VertexArray> {
    return this.#runs[index];
  }

  /**
   * Takes what is to be drawn.
   * @param nodes of one table, by rising row
   * @param reads what the program reads of each point
   */
  fill(nodes: readonly ListedNode<VertexArray>[], reads: AttributeSet): void {
    this.#reserve(nodes.length);
    this.#length = 0;
    this.#used = 0;
    let run: DrawRun<VertexArray> | undefined;
    for (const { uploaded, row, count } of nodes) {
      const array = uploaded.arrayOf(reads);
      const at = this.#length++;
      this.#firsts[at] = uploaded.first;
      this.#counts[at] = count;
      if (run?.array !== array || row !== run.row + at - run.begin) run = this.#begin(array, row, at);
      run.end = at + 1;
    }
  }

  /** Forgets what it has, so that nothing of it is kept alive. */
  clear(): void {
    this.#length = 0;
    this.#used = 0;
    this.#runs.length = 0;
  }

  #begin(array: VertexArray, row: number, begin: number): DrawRun<VertexArray> {
    const index = this.#used++;
    const run = this.#runs[index];
    if (run) return Object.assign(run, { array, row, begin });
    this.#runs[index] = { array, row, begin, end: begin };
    return this.#runs[index];
  }

  #reserve(draws: number): void {
    if (draws <= this.#firsts.length) return;
    this.#firsts = new Int32Array(2 * draws);
    this.#counts = new Int32Array(2 * draws);
  }
}
