import { BITS, type CellGrid, mortonSort } from "./morton-sort.js";

/**
 * An order in which every prefix of a node's points is an even sample of it, after M. Kanzok et al. 2015, who draw
 * prefixes of shuffled points. Better than chance: first one point of each cell of the coarsest grid, then one of each
 * cell of the next that has none yet, and so on down; and of one grid's points, those of every second, fourth,
 * eighth … along the Morton curve first (the sequence of van der Corput 1935: ranks with their bits reversed).
 *
 * @param xyz LAS integers, 3 per point
 * @returns record index of each drawn point
 */
export function drawingOrder(xyz: Int32Array, count: number, grid: CellGrid): Uint16Array | Uint32Array {
  const { indices, codes } = mortonSort(xyz, count, grid);
  const order = count <= 0x10000 ? new Uint16Array(count) : new Uint32Array(count);
  // Level 0 is the cube; what shares its finest cell with the point before comes last.
  const first = new Uint32Array(BITS + 3);
  for (let rank = 0; rank < count; rank++) first[levelOf(codes, rank) + 1]++;
  for (let level = 1; level < first.length; level++) first[level] += first[level - 1];
  const members = new Uint32Array(count);
  const next = first.slice();
  for (let rank = 0; rank < count; rank++) members[next[levelOf(codes, rank)]++] = indices[rank];
  for (let level = 0, drawn = 0; level + 1 < first.length; level++) {
    const size = first[level + 1] - first[level];
    const bits = size > 1 ? 32 - Math.clz32(size - 1) : 0;
    for (let turn = 0; turn < 1 << bits; turn++) {
      const rank = bits === 0 ? 0 : reversed(turn) >>> (32 - bits);
      if (rank < size) order[drawn++] = members[first[level] + rank];
    }
  }
  return order;
}

/** The coarsest level at which a point is the first of its cell along the curve; BITS + 1 where it is at none. */
function levelOf(codes: Uint32Array, rank: number): number {
  if (rank === 0) return 0;
  const different = codes[rank] ^ codes[rank - 1];
  return different === 0 ? BITS + 1 : BITS - Math.floor((31 - Math.clz32(different)) / 3);
}

/** A 32-bit number with its bits in reverse. */
function reversed(value: number): number {
  let bits = value;
  bits = ((bits >>> 1) & 0x55555555) | ((bits & 0x55555555) << 1);
  bits = ((bits >>> 2) & 0x33333333) | ((bits & 0x33333333) << 2);
  bits = ((bits >>> 4) & 0x0f0f0f0f) | ((bits & 0x0f0f0f0f) << 4);
  bits = ((bits >>> 8) & 0x00ff00ff) | ((bits & 0x00ff00ff) << 8);
  return (bits >>> 16) | (bits << 16);
}
