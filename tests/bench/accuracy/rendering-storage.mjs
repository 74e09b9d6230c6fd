import { open, readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { LazDecoder, LocalExecutor, PointCloud } from "@groma/layer";
import { openSource } from "@groma/layer/sources";

const laz = createRequire(import.meta.url).resolve("@groma/layer/laz.wasm");

/** Nodes of a level, and points of a node, that are looked at: evenly out of all. */
const NODES_PER_LEVEL = 6;
const POINTS_PER_NODE = 2000;

/** How coordinates in the node frame may be stored. The shader multiplies and adds in float32. */
export const STORAGES = [
  { storage: "uint16 × 3", bytes: 6, store: steps(16) },
  { storage: "whole steps × 3", bytes: 8, store: wholeSteps, chosen: true },
  { storage: "float32 × 3", bytes: 12, store: (value) => Math.fround(value) },
];

/** The positions that the page draws, of a fit that keeps the tolerance with them: at whole steps where there is room, else float32. */
export const DRAWN = "drawn";

/** Whole steps of a power of two of a metre, 2²⁰ to either side, which float32 holds: as the page stores them where there is room. */
function wholeSteps(value, _least, _greatest, reach) {
  const step = 2 ** Math.ceil(Math.log2(reach / (2 ** 20 - 1)));
  return Math.round(value / step) * step;
}

/** Coordinates as so many bits between a box's ends, as the vertex shader would bring them back. */
function steps(bits) {
  const most = 2 ** bits - 1;
  return (value, least, greatest) => {
    const scale = Math.fround((greatest - least) / most);
    if (scale === 0) return Math.fround(least);
    const stored = Math.max(0, Math.min(most, Math.round((value - least) / scale)));
    return Math.fround(Math.fround(stored * scale) + Math.fround(least));
  };
}

/**
 * Error (metres) of each storage at nodes of all levels of a scan: distance from the float64 place of the records. With
 * it, as {@link DRAWN}, the positions that the page really draws, which come of a fit.
 *
 * @param {string} file COPC
 */
export async function measureStorage(file) {
  const source = await fileSource(file);
  const cloud = await PointCloud.fromUrl(source, {
    executor: new LocalExecutor(new LazDecoder(() => readFile(laz))),
  });
  try {
    const rows = [];
    for (const [level, names] of await nodesByLevel(source)) {
      for (const name of evenly(names, NODES_PER_LEVEL)) {
        const node = await exactNode(cloud, name);
        const reach = Math.max(...node.box.map(Math.abs));
        for (const { storage, bytes, store, chosen = false } of STORAGES) {
          const error = errorOf(node, (i, axis) =>
            store(node.exact[3 * i + axis], node.box[axis], node.box[axis + 3], reach),
          );
          rows.push({ ...describe(node, name, level), storage, bytes, ...error, chosen });
        }
        const drawn = errorOf(node, (i, axis) => node.drawn[3 * i + axis]);
        const { bytes } = node;
        rows.push({ ...describe(node, name, level), storage: DRAWN, bytes, ...drawn, chosen: false });
      }
    }
    return { rows, step: Math.max(...cloud.scale) * cloud.crs.horizontalUnit.size };
  } finally {
    cloud.destroy();
    await source.close();
  }
}

function describe({ edge, box }, node, level) {
  return { part: "storage", node, level, edge, height: box[5] - box[2] };
}

/** Places of some of a node's records in its frame: in float64 from the map itself, and as the page draws them. */
async function exactNode(cloud, name) {
  const { positions, step, frame, box: drawnBox, bound, count } = await cloud.loadNode(name);
  // Exact places may lie beyond those drawn, by as much as is certified.
  const box = Float64Array.from(drawnBox, (value, side) => value + (side < 3 ? -bound : bound));
  const { origin, rotation: r } = frame;
  const picked = evenly(
    Array.from({ length: count }, (_, i) => i),
    POINTS_PER_NODE,
  );
  const exact = new Float64Array(3 * picked.length);
  const drawn = new Float64Array(3 * picked.length);
  for (const [i, index] of picked.entries()) {
    const { source } = await cloud.readPoint(name, index);
    const away = cloud.place(...source).map((value, axis) => value - origin[axis]);
    for (let axis = 0; axis < 3; axis++) {
      exact[3 * i + axis] = r[3 * axis] * away[0] + r[3 * axis + 1] * away[1] + r[3 * axis + 2] * away[2];
      drawn[3 * i + axis] = positions[3 * index + axis];
    }
  }
  const edge = Math.max(box[3] - box[0], box[4] - box[1]);
  return { exact, drawn, box, count: picked.length, edge, bytes: step === undefined ? 12 : 8 };
}

/** Greatest and mean distance, metres. */
function errorOf({ exact, count }, stored) {
  let worst = 0;
  let sum = 0;
  for (let i = 0; i < count; i++) {
    const away = Math.hypot(...[0, 1, 2].map((axis) => stored(i, axis) - exact[3 * i + axis]));
    worst = Math.max(worst, away);
    sum += away;
  }
  return { worst, mean: sum / count };
}

/** Names of the nodes with points by level, from all pages of the hierarchy. */
async function nodesByLevel(bytes) {
  const source = await openSource(bytes);
  const levels = new Map();
  const pages = [source.rootPage];
  for (let page = pages.pop(); page !== undefined; page = pages.pop()) {
    for (const { depth, x, y, z, pointCount, address } of await source.page(page)) {
      if (pointCount < 0) pages.push(address);
      if (pointCount <= 0) continue;
      levels.set(depth, [...(levels.get(depth) ?? []), `${depth}-${x}-${y}-${z}`]);
    }
  }
  return [...levels].sort(([a], [b]) => a - b);
}

function evenly(values, most) {
  const count = Math.min(values.length, most);
  return Array.from({ length: count }, (_, i) => values[Math.floor(((i + 0.5) * values.length) / count)]);
}

async function fileSource(path) {
  const handle = await open(path);
  const { size } = await handle.stat();
  return {
    name: path,
    size,
    async read(begin, end) {
      const bytes = new Uint8Array(Math.min(end, size) - begin);
      await handle.read(bytes, 0, bytes.length, begin);
      return bytes;
    },
    close: () => handle.close(),
  };
}
