import type { NodeBounds } from "../octree/index.js";

/** Share of a sphere's radius that the error of an affine map may add to it. */
const LARGEST_ERROR = 0.02;

/** Source coordinates → ECEF over one box, as an affine map. */
export interface AffineMap {
  /** Middle of the box, source units, and its place. */
  readonly middle: readonly number[];
  readonly place: readonly number[];
  /** Metres per source unit along x, y and z: 9 numbers, column by column. */
  readonly columns: readonly number[];
  /** Metres by which places of the box may be off. */
  readonly error: number;
  /** Metres per source unit in plane. */
  readonly scale: number;
  /** Metres per source unit in whatever direction, at most. */
  readonly stretch: number;
}

/**
 * Affine map through the samples of a box; undefined where one of them is no place.
 * @param box min x, y, z, max x, y, z, source units
 * @param samples ECEF of a grid of 3 × 3 in plane, each low and high: 54 numbers, as `NodeGeometry` takes them
 * @param unit metres per source unit where the box has no extent to find it by
 */
export function affineMap(
  box: ArrayLike<number>,
  samples: Float64Array,
  unit: number,
): AffineMap | undefined {
  if (!samples.every(Number.isFinite)) return undefined;
  const at = (i: number, j: number, high: number, axis: number) => samples[6 * (3 * j + i) + 3 * high + axis];
  const extent = [0, 1, 2].map((axis) => box[axis + 3] - box[axis]);
  const mean = (of: (high: number) => number) => (of(0) + of(1)) / 2;
  const slope = (difference: number, axis: number) => (extent[axis] > 0 ? difference / extent[axis] : 0);
  const columns = [
    ...[0, 1, 2].map((axis) =>
      slope(
        mean((high) => at(2, 1, high, axis) - at(0, 1, high, axis)),
        0,
      ),
    ),
    ...[0, 1, 2].map((axis) =>
      slope(
        mean((high) => at(1, 2, high, axis) - at(1, 0, high, axis)),
        1,
      ),
    ),
    ...[0, 1, 2].map((axis) => slope(at(1, 1, 1, axis) - at(1, 1, 0, axis), 2)),
  ];
  const middle = [0, 1, 2].map((axis) => (box[axis] + box[axis + 3]) / 2);
  const place = [0, 1, 2].map((axis) => mean((high) => at(1, 1, high, axis)));
  let off = 0;
  for (let sample = 0; sample < 18; sample++) {
    const high = sample % 2;
    const i = (sample >> 1) % 3;
    const j = Math.floor(sample / 6);
    const steps = [((i - 1) / 2) * extent[0], ((j - 1) / 2) * extent[1], (high - 0.5) * extent[2]];
    const distances = place.map((value, axis) => {
      const mapped = steps.reduce((sum, step, k) => sum + step * columns[3 * k + axis], value);
      return mapped - at(i, j, high, axis);
    });
    off = Math.max(off, Math.hypot(...distances));
  }
  const lengths = [0, 3, 6].map((from) => Math.hypot(columns[from], columns[from + 1], columns[from + 2]));
  const scale = Math.max(lengths[0], lengths[1]) || unit;
  // What lies between the samples may be off as much again.
  return { middle, place, columns, error: 2 * off, scale, stretch: Math.hypot(...lengths) };
}

/**
 * Sphere around a smaller box; undefined where the map's error would make it too large.
 * @param spacing of the points in it, source units
 */
export function affineBounds(
  map: AffineMap,
  box: ArrayLike<number>,
  spacing: number,
): NodeBounds | undefined {
  const { middle, place, columns, error, scale, stretch } = map;
  const a = (box[3] - box[0]) / 2;
  const b = (box[4] - box[1]) / 2;
  const c = (box[5] - box[2]) / 2;
  // No diagonal is longer than this: most maps that are too coarse are told by it alone.
  if (error > LARGEST_ERROR * stretch * Math.sqrt(a * a + b * b + c * c)) return undefined;
  const [ax, ay, az, bx, by, bz, cx, cy, cz] = columns;
  // A map through a flat box says nothing of what lies above it.
  const flat = (half: number, x: number, y: number, z: number) => half > 0 && x === 0 && y === 0 && z === 0;
  if (flat(a, ax, ay, az) || flat(b, bx, by, bz) || flat(c, cx, cy, cz)) return undefined;
  const i = box[0] + a - middle[0];
  const j = box[1] + b - middle[1];
  const k = box[2] + c - middle[2];
  let square = 0;
  // The longest of the four diagonals.
  for (let signs = 0; signs < 4; signs++) {
    const d = signs & 1 ? b : -b;
    const e = signs & 2 ? c : -c;
    const x = a * ax + d * bx + e * cx;
    const y = a * ay + d * by + e * cy;
    const z = a * az + d * bz + e * cz;
    square = Math.max(square, x * x + y * y + z * z);
  }
  const radius = Math.sqrt(square);
  if (error > LARGEST_ERROR * radius) return undefined;
  return {
    x: place[0] + i * ax + j * bx + k * cx,
    y: place[1] + i * ay + j * by + k * cy,
    z: place[2] + i * az + j * bz + k * cz,
    radius: radius + error,
    spacing: spacing * scale,
  };
}
