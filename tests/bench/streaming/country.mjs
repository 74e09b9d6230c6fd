/** Edge of the octree's cube, metres: a country in UTM. */
export const EDGE = 102_400;
/** Westing and southing of the cube's corner. */
export const CORNER = [450_000, 5_200_000];
/** Points of each node. */
export const NODE_POINTS = 20_000;
/** Levels below the root; a flat country has four children per node. */
const DEPTH = 10;
/** Level at which the pages of the hierarchy begin that the root page refers to. */
const PAGE_DEPTH = 5;
const ENTRY = 32;
const CHUNK = 64;
const POINTS_OFFSET = 700;

/** Nodes of all levels from one to another under one node of the first. */
const nodesOf = (from, to) => (4 ** (to - from + 1) - 1) / 3;

/** Nodes of the whole country. */
export const NODES = nodesOf(0, DEPTH);

const PAGE_LENGTH = ENTRY * nodesOf(PAGE_DEPTH, DEPTH);
const ROOT_LENGTH = ENTRY * (nodesOf(0, PAGE_DEPTH - 1) + 4 ** PAGE_DEPTH);
const ROOT_PAGE = 10_000;
const FIRST_PAGE = ROOT_PAGE + ROOT_LENGTH;

/** The octree of a country with more than a million nodes as a source of bytes: made up where it is read. */
export function countrySource() {
  const head = headOf();
  return {
    name: "country.copc.laz",
    size: FIRST_PAGE + 4 ** PAGE_DEPTH * PAGE_LENGTH,
    async read(begin, end) {
      if (end <= head.length) return head.slice(begin, end);
      if (begin === ROOT_PAGE) return rootPage();
      if (begin >= FIRST_PAGE) return page((begin - FIRST_PAGE) / PAGE_LENGTH);
      return new Uint8Array(end - begin);
    },
  };
}

/** Header and info record of COPC 1.0. */
function headOf() {
  const bytes = new Uint8Array(POINTS_OFFSET);
  const view = new DataView(bytes.buffer);
  const text = (at, value) => bytes.set(new TextEncoder().encode(value), at);
  const doubles = (at, ...values) => {
    for (const [index, value] of values.entries()) view.setFloat64(at + 8 * index, value, true);
  };
  text(0, "LASF");
  bytes.set([1, 4], 24);
  view.setUint16(94, 375, true);
  view.setUint32(96, POINTS_OFFSET, true);
  view.setUint32(100, 1, true);
  view.setUint8(104, 0x87);
  view.setUint16(105, 36, true);
  doubles(131, 0.001, 0.001, 0.001, CORNER[0], CORNER[1], 0);
  const [x, y] = CORNER;
  doubles(179, x + EDGE, x, y + EDGE, y, 90, 0);
  view.setBigUint64(247, BigInt(NODES * NODE_POINTS), true);
  text(377, "copc");
  view.setUint16(393, 1, true);
  view.setUint16(395, 160, true);
  doubles(429, x + EDGE / 2, y + EDGE / 2, EDGE / 2, EDGE / 2, EDGE / 128);
  view.setBigUint64(469, BigInt(ROOT_PAGE), true);
  view.setBigUint64(477, BigInt(ROOT_LENGTH), true);
  return bytes;
}

function rootPage() {
  const entries = entriesOf(ROOT_LENGTH);
  for (let depth = 0; depth < PAGE_DEPTH; depth++) {
    for (let y = 0; y < 2 ** depth; y++) for (let x = 0; x < 2 ** depth; x++) entries.node(depth, x, y);
  }
  const side = 2 ** PAGE_DEPTH;
  for (let index = 0; index < side * side; index++) {
    const offset = FIRST_PAGE + index * PAGE_LENGTH;
    entries.add(PAGE_DEPTH, index % side, Math.floor(index / side), offset, PAGE_LENGTH, -1);
  }
  return entries.bytes;
}

function page(index) {
  const entries = entriesOf(PAGE_LENGTH);
  const side = 2 ** PAGE_DEPTH;
  const [x, y] = [index % side, Math.floor(index / side)];
  for (let depth = PAGE_DEPTH; depth <= DEPTH; depth++) {
    const size = 2 ** (depth - PAGE_DEPTH);
    for (let row = 0; row < size; row++) {
      for (let column = 0; column < size; column++) entries.node(depth, x * size + column, y * size + row);
    }
  }
  return entries.bytes;
}

function entriesOf(length) {
  const bytes = new Uint8Array(length);
  const view = new DataView(bytes.buffer);
  let at = 0;
  const add = (depth, x, y, offset, size, points) => {
    for (const [index, value] of [depth, x, y, 0].entries()) view.setInt32(at + 4 * index, value, true);
    view.setBigUint64(at + 16, BigInt(offset), true);
    view.setInt32(at + 24, size, true);
    view.setInt32(at + 28, points, true);
    at += ENTRY;
  };
  return { bytes, add, node: (depth, x, y) => add(depth, x, y, POINTS_OFFSET, CHUNK, NODE_POINTS) };
}
