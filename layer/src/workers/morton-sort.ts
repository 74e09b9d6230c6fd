/** Bits per axis of a Morton code: a node's cube in 1024³ cells, eight to the usual spacing of its points. */
export const BITS = 10;
const CELLS = 1 << BITS;

/** The bits of 0 to 1023, each followed by two zeros (G. M. Morton, 1966). */
const SPREAD = Uint32Array.from({ length: CELLS }, (_, value) => {
  let spread = 0;
  for (let bit = 0; bit < BITS; bit++) spread |= ((value >> bit) & 1) << (3 * bit);
  return spread;
});

/** Where points lie in the cells of a node's cube: cell = integer · factor + shift, per axis. */
export interface CellGrid {
  readonly factor: readonly number[];
  readonly shift: readonly number[];
}

/**
 * Grid of a node's cube.
 * @param cube min x, y, z and edge, source units
 */
export function cellGrid(
  cube: readonly [number, number, number, number],
  scale: readonly number[],
  offset: readonly number[],
): CellGrid {
  const perUnit = CELLS / (cube[3] > 0 ? cube[3] : 1);
  return {
    factor: scale.map((step) => step * perUnit),
    shift: offset.map((from, axis) => (from - cube[axis]) * perUnit),
  };
}

/** Arrays that sorting needs and that outlive it, so that a worker does not allocate them for each node. */
let scratch = { keys: new Uint32Array(0), otherKeys: new Uint32Array(0), others: new Uint32Array(0) };
const counters = new Uint32Array(CELLS);

/** Points along the Morton curve. */
export interface MortonOrder {
  /** Indices of the points. */
  readonly indices: Uint32Array;
  /** Their codes, rising: three bits per level of cells, the coarsest highest. Valid until the next sort. */
  readonly codes: Uint32Array;
}

/**
 * Sorts points along the Morton curve through a node's cube; points of one cell stay in the order of their records.
 * @param xyz LAS integers, 3 per point
 */
export function mortonSort(xyz: Int32Array, count: number, { factor, shift }: CellGrid): MortonOrder {
  if (scratch.keys.length < count) {
    const array = () => new Uint32Array(count);
    scratch = { keys: array(), otherKeys: array(), others: array() };
  }
  let from = scratch.keys;
  let to = scratch.otherKeys;
  const [fx, fy, fz] = factor;
  const [sx, sy, sz] = shift;
  const last = CELLS - 1;
  for (let point = 0, at = 0; point < count; point++, at += 3) {
    const x = Math.max(0, Math.min(last, xyz[at] * fx + sx)) | 0;
    const y = Math.max(0, Math.min(last, xyz[at + 1] * fy + sy)) | 0;
    const z = Math.max(0, Math.min(last, xyz[at + 2] * fz + sz)) | 0;
    from[point] = SPREAD[x] | (SPREAD[y] << 1) | (SPREAD[z] << 2);
  }
  // Radix sort by ten bits at a time: after three passes the result lies in the array that is no scratch.
  let indices: Uint32Array = scratch.others;
  let others: Uint32Array = new Uint32Array(count);
  for (let point = 0; point < count; point++) indices[point] = point;
  for (let digit = 0; digit < 3 * BITS; digit += BITS) {
    counters.fill(0);
    for (let point = 0; point < count; point++) counters[(from[point] >>> digit) & last]++;
    for (let cell = 0, sum = 0; cell < CELLS; cell++) {
      const size = counters[cell];
      counters[cell] = sum;
      sum += size;
    }
    for (let point = 0; point < count; point++) {
      const key = from[point];
      const place = counters[(key >>> digit) & last]++;
      to[place] = key;
      others[place] = indices[point];
    }
    [from, to] = [to, from];
    [indices, others] = [others, indices];
  }
  return { indices, codes: from.subarray(0, count) };
}
