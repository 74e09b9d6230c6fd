/**
 * What a node's smooth fit leaves to a grid: the difference between the grid and the one bilinear function that the fit
 * contains in its place, over the cells that the node touches, as displacements of points. Plain data, crosses to
 * workers.
 */
export interface GridRemainder {
  /** Cells from west to east and from south to north. */
  readonly columns: number;
  readonly rows: number;
  /**
   * Twelve numbers per cell, row by row: along each axis in turn the displacement is a + b·e + c·n + d·e·n metres at e
   * and n cells from the cell's south-western corner.
   */
  readonly cells: Float64Array;
  /**
   * Position of a point in cells from the first cell's corner: of the column the terms 1, u, v, u², uv, v², then of
   * the row; u and v run from −1 to 1 over the node's domain.
   */
  readonly position: Float64Array;
}

/** Terms of a position per coordinate, of a displacement per axis, and numbers per cell. */
export const POSITION_TERMS = 6;
export const AXIS_TERMS = 4;
export const CELL_TERMS = 3 * AXIS_TERMS;

/** Adds the displacement of a point to the three numbers of `out`. */
export function addRemainder(
  { columns, rows, cells, position: p }: GridRemainder,
  u: number,
  v: number,
  out: Float64Array,
): void {
  const x = p[0] + u * (p[1] + u * p[3] + v * p[4]) + v * (p[2] + v * p[5]);
  const y = p[6] + u * (p[7] + u * p[9] + v * p[10]) + v * (p[8] + v * p[11]);
  const column = Math.max(0, Math.min(columns - 1, Math.floor(x)));
  const row = Math.max(0, Math.min(rows - 1, Math.floor(y)));
  const east = x - column;
  const north = y - row;
  for (let axis = 0; axis < 3; axis++) {
    const at = CELL_TERMS * (row * columns + column) + AXIS_TERMS * axis;
    out[axis] += cells[at] + east * cells[at + 1] + north * (cells[at + 2] + east * cells[at + 3]);
  }
}

/** The remainder from displacements at the nodes of the grid, `nodes[3 · (row · (columns + 1) + column) + axis]`. */
export function remainderOf(
  nodes: Float64Array,
  columns: number,
  rows: number,
  position: Float64Array,
): GridRemainder {
  const cells = new Float64Array(CELL_TERMS * columns * rows);
  const line = 3 * (columns + 1);
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      for (let axis = 0; axis < 3; axis++) {
        const from = row * line + 3 * column + axis;
        const at = CELL_TERMS * (row * columns + column) + AXIS_TERMS * axis;
        cells[at] = nodes[from];
        cells[at + 1] = nodes[from + 3] - nodes[from];
        cells[at + 2] = nodes[from + line] - nodes[from];
        cells[at + 3] = nodes[from + line + 3] - nodes[from + line] - cells[at + 1];
      }
    }
  }
  return { columns, rows, cells, position };
}

/** The same with its displacements turned from ECEF to a frame; `rotation` as in `Frame`. */
export function turned(remainder: GridRemainder, rotation: Float64Array): GridRemainder {
  const cells = new Float64Array(remainder.cells.length);
  for (let cell = 0; cell < cells.length; cell += CELL_TERMS) {
    for (let axis = 0; axis < 3; axis++) {
      for (let term = 0; term < AXIS_TERMS; term++) {
        let sum = 0;
        for (let c = 0; c < 3; c++) {
          sum += rotation[3 * axis + c] * remainder.cells[cell + AXIS_TERMS * c + term];
        }
        cells[cell + AXIS_TERMS * axis + term] = sum;
      }
    }
  }
  return { ...remainder, cells };
}

/** The same along the third axis alone. */
export function heightsOf(remainder: GridRemainder): GridRemainder {
  const cells = remainder.cells.map((term, at) => (at % CELL_TERMS < 2 * AXIS_TERMS ? 0 : term));
  return { ...remainder, cells };
}
