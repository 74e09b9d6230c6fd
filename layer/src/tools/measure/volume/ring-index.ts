/** Cells along each side. */
const CELLS = 128;

/** x and y of the vertices of a polygon. */
export type Places = readonly (readonly [number, number])[];

/** A ring in the plane: which places it holds, and where its edges are. */
export class RingIndex {
  /** x, y of each vertex in turn, the first not repeated, counter-clockwise. */
  readonly ring: Float64Array;
  readonly places: Places;
  readonly area: number;
  readonly #min: readonly [number, number];
  readonly #max: readonly [number, number];
  readonly #cell: readonly [number, number];
  /** Whether an edge may meet a cell. */
  readonly #edges = new Uint8Array(CELLS * CELLS);

  /** @param area of the ring, signed, as `planarArea` gives it */
  constructor(ring: Float64Array, area: number) {
    this.ring = area < 0 ? reversed(ring) : ring;
    this.places = Array.from(
      { length: ring.length / 2 },
      (_, i) => [this.ring[2 * i], this.ring[2 * i + 1]] as const,
    );
    this.area = Math.abs(area);
    let [minX, minY, maxX, maxY] = [Infinity, Infinity, -Infinity, -Infinity];
    for (let i = 0; i < ring.length; i += 2) {
      minX = Math.min(minX, ring[i]);
      maxX = Math.max(maxX, ring[i]);
      minY = Math.min(minY, ring[i + 1]);
      maxY = Math.max(maxY, ring[i + 1]);
    }
    this.#min = [minX, minY];
    this.#max = [maxX, maxY];
    this.#cell = [(maxX - minX) / CELLS || 1, (maxY - minY) / CELLS || 1];
    this.#mark();
  }

  /** Whether a place lies in the ring; on its edge it may or may not. */
  holds(x: number, y: number): boolean {
    const { ring } = this;
    let inside = false;
    for (let i = 0, j = ring.length - 2; i < ring.length; j = i, i += 2) {
      const [ay, by] = [ring[i + 1], ring[j + 1]];
      if (ay > y !== by > y && x < ring[i] + ((y - ay) / (by - ay)) * (ring[j] - ring[i])) inside = !inside;
    }
    return inside;
  }

  /** How a rectangle lies to the ring; `crossing` where that is not certain. */
  relation(minX: number, minY: number, maxX: number, maxY: number): "in" | "out" | "crossing" {
    const [x0, y0] = this.#min;
    const [x1, y1] = this.#max;
    if (maxX < x0 || minX > x1 || maxY < y0 || minY > y1) return "out";
    const [left, right] = [this.#column(0, minX), this.#column(0, maxX)];
    const [low, high] = [this.#column(1, minY), this.#column(1, maxY)];
    for (let row = low; row <= high; row++) {
      for (let column = left; column <= right; column++) {
        if (this.#edges[row * CELLS + column]) return "crossing";
      }
    }
    return this.holds(minX, minY) ? "in" : "out";
  }

  #column(axis: 0 | 1, value: number): number {
    return Math.min(CELLS - 1, Math.max(0, Math.floor((value - this.#min[axis]) / this.#cell[axis])));
  }

  #mark(): void {
    const { ring } = this;
    for (let i = 0, j = ring.length - 2; i < ring.length; j = i, i += 2) {
      const steps = Math.ceil(
        2 *
          Math.max(
            Math.abs(ring[i] - ring[j]) / this.#cell[0],
            Math.abs(ring[i + 1] - ring[j + 1]) / this.#cell[1],
          ),
      );
      for (let step = 0; step <= steps; step++) {
        const share = steps === 0 ? 0 : step / steps;
        const column = this.#column(0, ring[j] + share * (ring[i] - ring[j]));
        const row = this.#column(1, ring[j + 1] + share * (ring[i + 1] - ring[j + 1]));
        // Half a cell from the last one: with its neighbours no cell of the edge is left out.
        for (let y = Math.max(0, row - 1); y <= Math.min(CELLS - 1, row + 1); y++) {
          for (let x = Math.max(0, column - 1); x <= Math.min(CELLS - 1, column + 1); x++) {
            this.#edges[y * CELLS + x] = 1;
          }
        }
      }
    }
  }
}

function reversed(ring: Float64Array): Float64Array {
  const turned = new Float64Array(ring.length);
  for (let i = 0; i < ring.length; i += 2) turned.set(ring.subarray(i, i + 2), ring.length - 2 - i);
  return turned;
}
