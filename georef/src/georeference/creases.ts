import { AXIS_TERMS, CELL_TERMS, type GridRemainder, POSITION_TERMS } from "./grid-remainder.js";

/**
 * What grids add where one or two of their lines cross a node, in closed form: a function that is bilinear in each cell
 * is a bilinear one plus a fold along each line. Displacement = Σ |t_k| · fold_k, with t_k the distance from line k, linear
 * in u and v. No look-up and no branch per point. Plain data, crosses to workers.
 */
export interface Creases {
  /** Per line the terms 1, u, v of t, cells. */
  readonly lines: Float64Array;
  /** Per line and axis, metres per cell. */
  readonly folds: Float64Array;
}

/** A {@link GridRemainder} taken apart: polynomial + creases are as good as it but for `error`. */
export interface Unfolded {
  /** Axis by axis the terms 1, u, v, u², uv, v², metres. */
  readonly polynomial: Float64Array;
  readonly creases: Creases;
  /** Greatest length of what the creases add, metres. */
  readonly reach: number;
  /** Greatest distance of the sum from the remainder over the node, metres. */
  readonly error: number;
}

/** Lines that a node may have; with more of them looking a cell up is no slower. */
const LINES_MAX = 2;
/** Numbers per line in `lines` and in `folds`. */
const LINE_TERMS = 3;
export const QUADRATIC_TERMS = 6;

/** Adds the displacement of a point to the three numbers of `out`. */
export function addCreases({ lines, folds }: Creases, u: number, v: number, out: Float64Array): void {
  for (let from = 0; from < lines.length; from += LINE_TERMS) {
    const t = Math.abs(lines[from] + u * lines[from + 1] + v * lines[from + 2]);
    for (let axis = 0; axis < 3; axis++) out[axis] += t * folds[from + axis];
  }
}

/**
 * Takes a remainder apart.
 *
 * Along one direction the values f_0 … f_n at the nodes are A + B·x + Σ h_k |x − k| with the slopes s of the cells:
 * h_k = (s_k − s_(k−1)) / 2, B = (s_0 + s_(n−1)) / 2, A = f_0 − Σ h_k k. Both directions, one after the other, give the
 * coefficients G of all products. The position, quadratic in u and v, counts in full in A and B; of a fold its linear
 * part does, and the fold's value at the node's middle. What that leaves, and the products of folds, are the error.
 *
 * @returns nothing where more lines cross than two
 */
function unfold(remainder: GridRemainder): Unfolded | undefined {
  const { columns, rows, position } = remainder;
  const [across, along] = [columns - 1, rows - 1];
  if (across + along > LINES_MAX) return undefined;
  const g = coefficientsOf(remainder);
  const [x, y] = [position.subarray(0, POSITION_TERMS), position.subarray(POSITION_TERMS)];
  const folds = [
    ...Array.from({ length: across }, (_, k) => fold(x, k + 1, y, g(2 + k, 0), g(2 + k, 1))),
    ...Array.from({ length: along }, (_, k) => fold(y, k + 1, x, g(0, 2 + k), g(1, 2 + k))),
  ];
  const smooth = bilinearPart(x, y, [g(0, 0), g(1, 0), g(0, 1), g(1, 1)]);
  const corner = across === 1 && along === 1 ? norm(g(2, 2)) * folds[0].far * folds[1].far : 0;
  return {
    polynomial: smooth.polynomial,
    creases: {
      lines: Float64Array.from(folds.flatMap(({ line }) => line)),
      folds: Float64Array.from(folds.flatMap(({ vector }) => [...vector])),
    },
    reach: folds.reduce((sum, { far, vector }) => sum + far * norm(vector), 0),
    error: folds.reduce((sum, { error }) => sum + error, smooth.error + corner),
  };
}

/** Vectors of G: index 0 the constant, 1 the linear term, 2 … the lines; across, then along. */
function coefficientsOf({ columns, rows, cells }: GridRemainder): (i: number, j: number) => Float64Array {
  const value = (i: number, j: number, axis: number) => {
    const [column, row] = [Math.min(i, columns - 1), Math.min(j, rows - 1)];
    const at = CELL_TERMS * (row * columns + column) + AXIS_TERMS * axis;
    const [e, n] = [i - column, j - row];
    return cells[at] + e * cells[at + 1] + n * (cells[at + 2] + e * cells[at + 3]);
  };
  const axes = [0, 1, 2].map((axis) => {
    const byRow = Array.from({ length: rows + 1 }, (_, j) =>
      hinged(Array.from({ length: columns + 1 }, (_, i) => value(i, j, axis))),
    );
    return Array.from({ length: columns + 1 }, (_, i) => hinged(byRow.map((row) => row[i])));
  });
  return (i, j) => Float64Array.from(axes, (axis) => axis[i][j]);
}

/** A, B, h_1 … of values at 0, 1, 2 … */
function hinged(values: readonly number[]): number[] {
  const slopes = values.slice(1).map((value, i) => value - values[i]);
  const hinges = slopes.slice(1).map((slope, i) => (slope - slopes[i]) / 2);
  const start = hinges.reduce((sum, hinge, i) => sum - hinge * (i + 1), values[0]);
  return [start, (slopes[0] + slopes[slopes.length - 1]) / 2, ...hinges];
}

/** |p − line| · vector. */
interface Fold {
  readonly line: readonly number[];
  readonly vector: Float64Array;
  /** Greatest distance from the line, cells. */
  readonly far: number;
  readonly error: number;
}

/** |p − line| · (constant + linear · other), positions as terms 1, u, v, u², uv, v², with `other` in the middle. */
function fold(
  p: Float64Array,
  line: number,
  other: Float64Array,
  constant: Float64Array,
  linear: Float64Array,
): Fold {
  const bent = quadraticReach(p);
  const far = Math.abs(p[0] - line) + linearReach(p) + bent;
  const vector = constant.map((value, axis) => value + linear[axis] * other[0]);
  const change = norm(linear) * (linearReach(other) + quadraticReach(other));
  return { line: [p[0] - line, p[1], p[2]], vector, far, error: bent * norm(vector) + far * change };
}

/** a + b·x + c·y + d·x·y as terms 1, u, v, u², uv, v²; of x·y the terms beyond are left out. */
function bilinearPart(
  x: Float64Array,
  y: Float64Array,
  [a, b, c, d]: readonly Float64Array[],
): { polynomial: Float64Array; error: number } {
  const polynomial = new Float64Array(3 * QUADRATIC_TERMS);
  for (let axis = 0; axis < 3; axis++) {
    const own = polynomial.subarray(QUADRATIC_TERMS * axis, QUADRATIC_TERMS * (axis + 1));
    // About the middle: x·y = x₀·y₀ + x₀·(y − y₀) + y₀·(x − x₀) + (x − x₀)(y − y₀).
    const [byX, byY] = [b[axis] + d[axis] * y[0], c[axis] + d[axis] * x[0]];
    for (let term = 1; term < QUADRATIC_TERMS; term++) own[term] = byX * x[term] + byY * y[term];
    own[0] = a[axis] + b[axis] * x[0] + c[axis] * y[0] + d[axis] * x[0] * y[0];
    own[3] += d[axis] * x[1] * y[1];
    own[4] += d[axis] * (x[1] * y[2] + x[2] * y[1]);
    own[5] += d[axis] * x[2] * y[2];
  }
  const [bentX, bentY] = [quadraticReach(x), quadraticReach(y)];
  const error = norm(d) * (linearReach(x) * bentY + bentX * linearReach(y) + bentX * bentY);
  return { polynomial, error };
}

function linearReach(p: Float64Array): number {
  return Math.abs(p[1]) + Math.abs(p[2]);
}

function quadraticReach(p: Float64Array): number {
  return Math.abs(p[3]) + Math.abs(p[4]) + Math.abs(p[5]);
}

function norm(vector: Float64Array): number {
  return Math.hypot(vector[0], vector[1], vector[2]);
}

/** Several taken together, the lines of all; nothing where there are too many of them. */
export function unfoldAll(remainders: readonly GridRemainder[]): Unfolded | undefined {
  const parts: Unfolded[] = [];
  for (const remainder of remainders) {
    const part = unfold(remainder);
    if (!part) return undefined;
    parts.push(part);
  }
  const joined = (of: (part: Unfolded) => Float64Array) =>
    Float64Array.from(parts.flatMap((part) => [...of(part)]));
  const lines = joined(({ creases }) => creases.lines);
  if (lines.length > LINE_TERMS * LINES_MAX) return undefined;
  return {
    polynomial: parts
      .map(({ polynomial }) => polynomial)
      .reduce((sum, terms) => sum.map((value, i) => value + terms[i])),
    creases: { lines, folds: joined(({ creases }) => creases.folds) },
    reach: parts.reduce((sum, part) => sum + part.reach, 0),
    error: parts.reduce((sum, part) => sum + part.error, 0),
  };
}

/** Turned from ECEF to a frame; `rotation` as in `Frame`. */
export function turnedCreases({ lines, folds }: Creases, rotation: Float64Array): Creases {
  const turned = Float64Array.from(folds);
  for (let from = 0; from < folds.length; from += LINE_TERMS) {
    turned.set(turnedTerms(folds.subarray(from, from + LINE_TERMS), 1, rotation), from);
  }
  return { lines, folds: turned };
}

/** Terms of three axes, axis by axis, turned from ECEF to a frame. */
export function turnedTerms(terms: Float64Array, count: number, rotation: Float64Array): Float64Array {
  return Float64Array.from(terms, (_, i) => {
    const axis = Math.floor(i / count);
    const term = i % count;
    let sum = 0;
    for (let c = 0; c < 3; c++) sum += rotation[3 * axis + c] * terms[count * c + term];
    return sum;
  });
}
