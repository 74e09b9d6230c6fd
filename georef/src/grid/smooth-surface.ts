import { columnAt, isNoData, rowAt, type Surface } from "./surface.js";
import type { GridWindow } from "./window.js";

/** Positions in a window in cells. */
export interface CellRange {
  readonly minColumn: number;
  readonly maxColumn: number;
  readonly minRow: number;
  readonly maxRow: number;
}

/** One bilinear function in place of a part of a grid, and what it leaves. */
export interface SmoothPart {
  readonly surface: Surface;
  /** First node of the part in the window, and how many. */
  readonly column: number;
  readonly row: number;
  readonly columns: number;
  readonly rows: number;
  /** Grid minus surface at these nodes, radians or metres: `[(channel · rows + row) · columns + column]`. */
  readonly remainder: Float64Array;
  /** By channel: the greatest remainder within the range. */
  readonly greatest: Float64Array;
  /** By channel: the greatest change of the remainder from one node to the next, along a row and along a column. */
  readonly slopeColumn: Float64Array;
  readonly slopeRow: Float64Array;
}

/**
 * Splits a grid over a range into the bilinear function a + b·column + c·row + d·column·row that is nearest to it in
 * the least squares over the corners of the cells' parts inside the range, and the remainder, which is bilinear in
 * each cell again. Within a single cell nothing remains.
 *
 * @returns nothing where nodes without data lie in or around the range
 */
export function smoothPart(window: GridWindow, range: CellRange): SmoothPart | undefined {
  const { channels, values, unit, stepLongitude, stepLatitude } = window;
  const [column, columns] = nodesOf(range.minColumn, range.maxColumn, window.columns);
  const [row, rows] = nodesOf(range.minRow, range.maxRow, window.rows);
  // Positions are counted from the first node of the part: small numbers, no digits lost.
  const xs = corners(range.minColumn - column, range.maxColumn - column, columns);
  const ys = corners(range.minRow - row, range.maxRow - row, rows);
  const forms = new Float64Array(4 * channels);
  const remainder = new Float64Array(channels * rows * columns);
  const [greatest, slopeColumn, slopeRow] = [0, 0, 0].map(() => new Float64Array(channels));

  for (let c = 0; c < channels; c++) {
    const nodes = remainder.subarray(c * rows * columns, (c + 1) * rows * columns);
    for (let j = 0; j < rows; j++) {
      for (let i = 0; i < columns; i++) {
        const value = values[(c * window.rows + row + j) * window.columns + column + i];
        if (isNoData(window, value)) return undefined;
        nodes[j * columns + i] = Math.fround(value * unit);
      }
    }
    const form = forms.subarray(4 * c, 4 * c + 4);
    form.set(nearestForm(nodes, columns, xs, ys));
    for (let j = 0; j < rows; j++) for (let i = 0; i < columns; i++) nodes[j * columns + i] -= at(form, i, j);
    for (const x of xs) {
      for (const y of ys) greatest[c] = Math.max(greatest[c], Math.abs(interpolate(nodes, columns, x, y)));
    }
    for (let j = 0; j < rows; j++) {
      for (let i = 0; i < columns; i++) {
        const node = nodes[j * columns + i];
        if (i > 0) slopeColumn[c] = Math.max(slopeColumn[c], Math.abs(node - nodes[j * columns + i - 1]));
        if (j > 0) slopeRow[c] = Math.max(slopeRow[c], Math.abs(node - nodes[(j - 1) * columns + i]));
      }
    }
  }
  const surface: Surface = (longitude, latitude, out) => {
    const x = columnAt(window, longitude) - column;
    const y = rowAt(window, latitude) - row;
    for (let c = 0; c < channels; c++) {
      const [b, d] = [forms[4 * c + 1], forms[4 * c + 3]];
      out[3 * c] = forms[4 * c] + b * x + (forms[4 * c + 2] + d * x) * y;
      out[3 * c + 1] = (b + d * y) / stepLongitude;
      out[3 * c + 2] = (forms[4 * c + 2] + d * x) / stepLatitude;
    }
  };
  return { surface, column, row, columns, rows, remainder, greatest, slopeColumn, slopeRow };
}

/** First node and number of nodes of the cells that a range touches, within the window. */
function nodesOf(from: number, to: number, count: number): [first: number, nodes: number] {
  const first = Math.max(0, Math.min(count - 2, Math.floor(from)));
  const last = Math.max(first + 1, Math.min(count - 1, Math.ceil(to)));
  return [first, last - first + 1];
}

/** The ends of a range and the nodes between them. */
function corners(from: number, to: number, nodes: number): number[] {
  const between = Array.from({ length: nodes }, (_, i) => i).filter((i) => i > from && i < to);
  return [from, ...between, to];
}

/** a, b, c, d of a + b·x + c·y + d·x·y. */
type Form = Float64Array;

function at(form: Form, x: number, y: number): number {
  return form[0] + form[1] * x + (form[2] + form[3] * x) * y;
}

/** Least squares over the points xs × ys: a line along each row, then a line through their parameters. */
function nearestForm(
  nodes: Float64Array,
  columns: number,
  xs: readonly number[],
  ys: readonly number[],
): Form {
  const lines = ys.map((y) =>
    line(
      xs,
      xs.map((x) => interpolate(nodes, columns, x, y)),
    ),
  );
  const [a, c] = line(
    ys,
    lines.map(([start]) => start),
  );
  const [b, d] = line(
    ys,
    lines.map(([, slope]) => slope),
  );
  return Float64Array.of(a, b, c, d);
}

/** Least-squares line through points. */
function line(xs: readonly number[], values: readonly number[]): [start: number, slope: number] {
  const mean = (of: readonly number[]) => of.reduce((sum, value) => sum + value, 0) / of.length;
  const x = mean(xs);
  const value = mean(values);
  let square = 0;
  let product = 0;
  for (let i = 0; i < xs.length; i++) {
    square += (xs[i] - x) ** 2;
    product += (xs[i] - x) * (values[i] - value);
  }
  const slope = square > 0 ? product / square : 0;
  return [value - slope * x, slope];
}

function interpolate(nodes: Float64Array, columns: number, x: number, y: number): number {
  const i = Math.max(0, Math.min(columns - 2, Math.floor(x)));
  const j = Math.max(0, Math.min(nodes.length / columns - 2, Math.floor(y)));
  const south = nodes[j * columns + i] + (x - i) * (nodes[j * columns + i + 1] - nodes[j * columns + i]);
  const above = nodes[(j + 1) * columns + i];
  const north = above + (x - i) * (nodes[(j + 1) * columns + i + 1] - above);
  return south + (y - j) * (north - south);
}
