import { AXIS_TERMS, CELL_TERMS, type GridRemainder, POSITION_TERMS } from "./grid-remainder.js";

/**
 * A {@link GridRemainder} of heights: what it adds lies along the node frame's up to within its error, and its position
 * is linear. Plain data, crosses to workers.
 */
export interface Relief {
  /** Cells from west to east and from south to north. */
  readonly columns: number;
  readonly rows: number;
  /** Position x, then y, counted in cells: terms 1, u, v each. */
  readonly position: Float64Array;
  /**
   * Per cell, row by row, the terms 1, x, y, xy of what is added to up, metres; x and y from the first cell's corner.
   * The last cell of each row and column stands twice, and zeros fill up to a power of two: a point outside of the node
   * then reads something at least, and the kernel needs no comparison.
   */
  readonly cells: Float64Array;
}

const RELIEF_TERMS = 4;

/** Adds the displacement of a point to the third of the numbers of `out`. */
export function addRelief(
  { columns, rows, position, cells }: Relief,
  u: number,
  v: number,
  out: Float64Array,
): void {
  const x = position[0] + u * position[1] + v * position[2];
  const y = position[3] + u * position[4] + v * position[5];
  const column = Math.max(0, Math.min(columns, Math.floor(x)));
  const row = Math.max(0, Math.min(rows, Math.floor(y)));
  const at = RELIEF_TERMS * (row * (columns + 1) + column);
  out[2] += cells[at] + x * cells[at + 1] + y * (cells[at + 2] + x * cells[at + 3]);
}

/**
 * What of a remainder lies along up.
 *
 * @param remainder axes of the node frame
 * @returns the relief, and by how much it may differ from the remainder, metres: its greatest part along east and
 *   north, and its slope over the quadratic part of the position
 */
export function reliefOf(remainder: GridRemainder): { relief: Relief; error: number } {
  const { columns, rows, cells, position: p } = remainder;
  const out = new Float64Array(2 ** Math.ceil(Math.log2(RELIEF_TERMS * (columns + 1) * (rows + 1))));
  let [level, slopeX, slopeY] = [0, 0, 0];
  for (let j = 0; j <= rows; j++) {
    for (let i = 0; i <= columns; i++) {
      const [column, row] = [Math.min(i, columns - 1), Math.min(j, rows - 1)];
      const from = CELL_TERMS * (row * columns + column);
      const [a, b, c, d] = cells.subarray(from + 2 * AXIS_TERMS, from + CELL_TERMS);
      const at = RELIEF_TERMS * (j * (columns + 1) + i);
      out[at] = a - b * column - c * row + d * column * row;
      out[at + 1] = b - d * row;
      out[at + 2] = c - d * column;
      out[at + 3] = d;
      level = Math.max(level, greatestLevel(cells, from));
      slopeX = Math.max(slopeX, Math.abs(b), Math.abs(b + d));
      slopeY = Math.max(slopeY, Math.abs(c), Math.abs(c + d));
    }
  }
  const bent = (at: number) => Math.abs(p[at + 3]) + Math.abs(p[at + 4]) + Math.abs(p[at + 5]);
  const position = Float64Array.of(...p.subarray(0, 3), ...p.subarray(POSITION_TERMS, POSITION_TERMS + 3));
  return {
    relief: { columns, rows, position, cells: out },
    error: level + slopeX * bent(0) + slopeY * bent(POSITION_TERMS),
  };
}

/** Greatest length along east and north at the corners of a cell. */
function greatestLevel(cells: Float64Array, from: number): number {
  let greatest = 0;
  for (let corner = 0; corner < 4; corner++) {
    const [e, n] = [corner & 1, corner >> 1];
    const along = (at: number) => cells[at] + e * cells[at + 1] + n * (cells[at + 2] + e * cells[at + 3]);
    greatest = Math.max(greatest, Math.hypot(along(from), along(from + AXIS_TERMS)));
  }
  return greatest;
}
