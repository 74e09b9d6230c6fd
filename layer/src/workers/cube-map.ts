import { type Placement, place } from "@groma/georef";

/** How far from the middle of a node's points the map is sampled at least, as share of the cube's edge. */
const LEAST_STEP = 0.01;

/** Affine map node frame → cube with its error; see `NodeVertices.toCube`. */
export interface CubeMap {
  readonly toCube: Float32Array;
  readonly toCubeError: number;
}

/**
 * Fits the affine map from the node frame to the node's cube, the inverse of what the placement does: the secants of
 * the placement through the box of the points, inverted, with the error measured at all points.
 * @param cube min x, y, z and edge, source units
 * @param xyz LAS integers, in the order of the records
 * @param positions metres in the node frame, drawing order
 * @param box of the positions
 */
export function cubeMap(
  placement: Placement,
  [minX, minY, minZ, edge]: readonly [number, number, number, number],
  { scale, offset }: { readonly scale: readonly number[]; readonly offset: readonly number[] },
  { xyz, order }: { readonly xyz: Int32Array; readonly order: ArrayLike<number> },
  positions: Float32Array,
  box: Float32Array,
): CubeMap {
  const { domain } = placement;
  const size = edge > 0 ? edge : 1;
  const low = [domain.minX, domain.minY, domain.minZ];
  const high = [domain.maxX, domain.maxY, domain.maxZ];
  const middle = low.map((from, axis) => (from + high[axis]) / 2);
  const step = stepsOver(low, high, size);
  // Columns: metres of the node frame per edge of the cube along x, y and z.
  const columns = [0, 1, 2].map((axis) => {
    const at = (sign: number) =>
      localOf(
        placement,
        middle.map((value, k) => (k === axis ? value + sign * step[axis] : value)),
      );
    const ahead = at(1);
    const behind = at(-1);
    return ahead.map((value, k) => ((value - behind[k]) / (2 * step[axis])) * size);
  });
  const inverse = invert(columns);
  const from = localOf(placement, middle);
  const corner = [minX, minY, minZ];
  const rows = inverse.map((row, axis) => {
    const target = (middle[axis] - corner[axis]) / size;
    return [...row, target - row.reduce((sum, value, k) => sum + value * from[k], 0)];
  });
  const toCube = Float32Array.from(rows.flat());
  const factor = scale.map((value) => value / size);
  const shift = offset.map((value, axis) => (value - corner[axis]) / size);
  return {
    toCube,
    toCubeError: worstError(toCube, { factor, shift }, xyz, order, positions) + roundingOf(toCube, box),
  };
}

/** The greatest error of all points, float64. */
function worstError(
  toCube: Float32Array,
  { factor, shift }: { readonly factor: readonly number[]; readonly shift: readonly number[] },
  xyz: Int32Array,
  order: ArrayLike<number>,
  positions: Float32Array,
): number {
  const [ae, an, au, a, be, bn, bu, b, ce, cn, cu, c] = toCube;
  const [fx, fy, fz] = factor;
  const [sx, sy, sz] = [a - shift[0], b - shift[1], c - shift[2]];
  let worst = 0;
  for (let point = 0, at = 0; at < positions.length; point++, at += 3) {
    const east = positions[at];
    const north = positions[at + 1];
    const up = positions[at + 2];
    const from = 3 * order[point];
    const x = Math.abs(ae * east + an * north + au * up + sx - xyz[from] * fx);
    const y = Math.abs(be * east + bn * north + bu * up + sy - xyz[from + 1] * fy);
    const z = Math.abs(ce * east + cn * north + cu * up + sz - xyz[from + 2] * fz);
    if (x > worst) worst = x;
    if (y > worst) worst = y;
    if (z > worst) worst = z;
  }
  return worst;
}

/** What the same sum costs in the float32 of a GPU: three products and three sums, each rounded. */
function roundingOf(toCube: Float32Array, box: Float32Array): number {
  const reach = [0, 1, 2].map((axis) => Math.max(Math.abs(box[axis]), Math.abs(box[axis + 3])));
  const terms = [0, 4, 8].map((row) =>
    reach.reduce((sum, metres, k) => sum + Math.abs(toCube[row + k]) * metres, Math.abs(toCube[row + 3])),
  );
  return 6 * 2 ** -24 * Math.max(...terms);
}

/** A place in the node frame, metres, float64. */
export function localOf(placement: Placement, [x, y, z]: readonly number[]): number[] {
  const ecef = new Float64Array(3);
  place(placement, x, y, z, ecef);
  const { origin, rotation } = placement.frame;
  const away = [0, 1, 2].map((axis) => ecef[axis] - origin[axis]);
  return [0, 3, 6].map((column) =>
    away.reduce((sum, value, axis) => sum + value * rotation[column + axis], 0),
  );
}

/** Least half extents of the box that a map is sampled over. */
export function stepsOver(low: readonly number[], high: readonly number[], size: number): number[] {
  return low.map((from, axis) => Math.max((high[axis] - from) / 2, LEAST_STEP * size));
}

/** Inverse of a 3 × 3 matrix given by its columns, by its rows; zeros where it has none. */
export function invert([a, b, c]: readonly (readonly number[])[]): number[][] {
  const rows = [cross(b, c), cross(c, a), cross(a, b)];
  const determinant = a[0] * rows[0][0] + a[1] * rows[0][1] + a[2] * rows[0][2];
  return rows.map((row) => row.map((value) => (determinant === 0 ? 0 : value / determinant)));
}

function cross(a: readonly number[], b: readonly number[]): number[] {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}
