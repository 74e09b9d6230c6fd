/** Ends of the segments of a polyline: ax, ay, bx, by of each. */
export type Segments = Float64Array;

/** Cells along the longer side, at most. */
const MOST_CELLS = 256;

/** Tells which segments come near a point, for polylines of any number of vertices. */
export class SegmentGrid {
  /** Least x and y of the corridor, and the edge of a cell. */
  readonly #x: number;
  readonly #y: number;
  readonly #cell: number;
  readonly #columns: number;
  readonly #rows: number;
  /** Where the segments of a cell begin in {@link members}. */
  readonly #begins: Uint32Array;
  /** Numbers of segments, rising within a cell. */
  readonly members: Uint32Array;
  /** Where the segments of the cell that was last asked for begin and end in {@link members}. */
  begin = 0;
  end = 0;

  /** @param reach distance at which a segment still counts as near */
  constructor(segments: Segments, reach: number) {
    let [minX, minY, maxX, maxY] = [Infinity, Infinity, -Infinity, -Infinity];
    for (let at = 0; at < segments.length; at += 2) {
      minX = Math.min(minX, segments[at]);
      maxX = Math.max(maxX, segments[at]);
      minY = Math.min(minY, segments[at + 1]);
      maxY = Math.max(maxY, segments[at + 1]);
    }
    // A little more than the reach, for points that rounding puts beyond it.
    const margin =
      reach * 1.001 + 1e-9 * Math.max(Math.abs(minX), Math.abs(maxX), Math.abs(minY), Math.abs(maxY));
    this.#x = minX - margin;
    this.#y = minY - margin;
    const [width, height] = [maxX - minX + 2 * margin, maxY - minY + 2 * margin];
    const count = segments.length / 4;
    this.#cell = Math.max(width, height) / Math.min(MOST_CELLS, Math.max(1, 2 * count));
    this.#columns = Math.max(1, Math.ceil(width / this.#cell));
    this.#rows = Math.max(1, Math.ceil(height / this.#cell));
    const sizes = new Uint32Array(this.#columns * this.#rows + 1);
    this.#eachCell(segments, margin, (cell) => sizes[cell + 1]++);
    for (let cell = 1; cell < sizes.length; cell++) sizes[cell] += sizes[cell - 1];
    this.#begins = sizes;
    this.members = new Uint32Array(sizes[sizes.length - 1]);
    const next = sizes.slice();
    this.#eachCell(segments, margin, (cell, segment) => {
      this.members[next[cell]++] = segment;
    });
  }

  /** Looks up the cell of a point: {@link begin} and {@link end} tell its segments, none where it lies beyond. */
  at(x: number, y: number): void {
    const column = Math.floor((x - this.#x) / this.#cell);
    const row = Math.floor((y - this.#y) / this.#cell);
    const inside = column >= 0 && row >= 0 && column < this.#columns && row < this.#rows;
    const cell = row * this.#columns + column;
    this.begin = inside ? this.#begins[cell] : 0;
    this.end = inside ? this.#begins[cell + 1] : 0;
  }

  /** Goes through the cells that each segment comes near, row by row. */
  #eachCell(segments: Segments, margin: number, visit: (cell: number, segment: number) => void): void {
    for (let segment = 0; 4 * segment < segments.length; segment++) {
      const [ax, ay, bx, by] = segments.subarray(4 * segment, 4 * segment + 4);
      const first = this.#row(Math.min(ay, by) - margin);
      const last = this.#row(Math.max(ay, by) + margin);
      for (let row = first; row <= last; row++) {
        const low = this.#y + row * this.#cell - margin;
        const high = low + this.#cell + 2 * margin;
        const [from, to] = stretch(ay, by, low, high);
        const [x0, x1] = [ax + from * (bx - ax), ax + to * (bx - ax)];
        const left = this.#column(Math.min(x0, x1) - margin);
        const right = this.#column(Math.max(x0, x1) + margin);
        for (let column = left; column <= right; column++) visit(row * this.#columns + column, segment);
      }
    }
  }

  #row(y: number): number {
    return Math.min(this.#rows - 1, Math.max(0, Math.floor((y - this.#y) / this.#cell)));
  }

  #column(x: number): number {
    return Math.min(this.#columns - 1, Math.max(0, Math.floor((x - this.#x) / this.#cell)));
  }
}

/** Shares of a segment from a to b at which it enters and leaves a stretch; the whole where it does not move. */
function stretch(a: number, b: number, low: number, high: number): readonly [number, number] {
  if (a === b) return [0, 1];
  const [s, t] = [(low - a) / (b - a), (high - a) / (b - a)];
  const clamped = (share: number) => Math.min(1, Math.max(0, share));
  return [clamped(Math.min(s, t)), clamped(Math.max(s, t))];
}
