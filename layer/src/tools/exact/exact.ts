// Decisions by whole numbers: every float64 is an integer times a power of two, and what is compared is homogeneous.

/** One float64 as mantissa · 2 ** exponent. */
function parts(value: number): readonly [mantissa: bigint, exponent: number] {
  const view = new DataView(new ArrayBuffer(8));
  view.setFloat64(0, value);
  const bits = view.getBigUint64(0);
  const field = Number((bits >> 52n) & 0x7ffn);
  const fraction = bits & 0xfffffffffffffn;
  const mantissa = field === 0 ? fraction : fraction | 0x10000000000000n;
  return [bits >> 63n === 1n ? -mantissa : mantissa, (field === 0 ? 1 : field) - 1075];
}

/** Finite numbers as integers of one common unit, a power of two. */
function integers(values: readonly number[]): bigint[] {
  const split = values.map(parts);
  const unit = Math.min(...split.filter(([mantissa]) => mantissa !== 0n).map(([, exponent]) => exponent));
  return split.map(([mantissa, exponent]) => (mantissa === 0n ? 0n : mantissa << BigInt(exponent - unit)));
}

/**
 * Whether a point lies beside a segment, at right angles to it and no farther than a distance, decided without any rounding.
 * Its edges count.
 * @param segment its ends: ax, ay, bx, by, which differ
 */
export function isBeside(
  x: number,
  y: number,
  segment: readonly [number, number, number, number],
  distance: number,
): boolean {
  const [px, py, ax, ay, bx, by, reach] = integers([x, y, ...segment, distance]);
  const [ux, uy] = [bx - ax, by - ay];
  const [vx, vy] = [px - ax, py - ay];
  const along = ux * vx + uy * vy;
  const square = ux * ux + uy * uy;
  if (along < 0n || along > square) return false;
  const across = ux * vy - uy * vx;
  return across * across <= reach * reach * square;
}

/**
 * Whether a point lies at the outer side of a joint, behind the end of one segment and before the start of the next, and no
 * farther from it than a distance; decided without any rounding. Edges count.
 * @param joint x and y of the start of the one, of the joint, and of the end of the next
 */
export function isAtJoint(
  x: number,
  y: number,
  joint: readonly [number, number, number, number, number, number],
  distance: number,
): boolean {
  const [px, py, ax, ay, bx, by, cx, cy, reach] = integers([x, y, ...joint, distance]);
  const [wx, wy] = [px - bx, py - by];
  const behind = (bx - ax) * wx + (by - ay) * wy >= 0n;
  const before = (cx - bx) * wx + (cy - by) * wy <= 0n;
  return behind && before && wx * wx + wy * wy <= reach * reach;
}

/** Relative error of a float64 operation. */
const EPSILON = 2 ** -53;

/**
 * On which side of the line from a to b a point lies: 1 to the left, -1 to the right, 0 on it; decided without any
 * rounding where float64 leaves a doubt.
 */
export function sideOf(x: number, y: number, ax: number, ay: number, bx: number, by: number): -1 | 0 | 1 {
  const first = (bx - ax) * (y - ay);
  const second = (by - ay) * (x - ax);
  const across = first - second;
  if (Math.abs(across) > 8 * EPSILON * (Math.abs(first) + Math.abs(second))) return across > 0 ? 1 : -1;
  const [px, py, ix, iy, jx, jy] = integers([x, y, ax, ay, bx, by]);
  const exact = (jx - ix) * (py - iy) - (jy - iy) * (px - ix);
  return exact === 0n ? 0 : exact > 0n ? 1 : -1;
}
