import { PointCloud } from "@groma/layer";
import { random } from "./accuracy/timing.mjs";
import { viewFrom } from "./streaming/camera.mjs";
import { CORNER, countrySource, EDGE, NODES } from "./streaming/country.mjs";
import { decodingFlights } from "./streaming/decoding.mjs";
import { flight } from "./streaming/flights.mjs";
import { mebibytes, memoryInUse } from "./streaming/memory.mjs";

/** Bytes of a node as the fake executor makes it: real memory, so that what is kept can be weighed. */
const NODE_BYTES = 16 * 1024;
const FLIGHTS = 500;
const FRAMES = 5;
const LIMITS = { requests: 16, cacheBytes: 16 * 1024 * 1024 };

/** Makes nodes of the right size out of nothing, so that streaming alone is measured. */
const executor = {
  pending: 0,
  addDataSet: () => 1,
  removeDataSet() {},
  destroy() {},
  async run({ pointCount, cube: [x, y, z] }) {
    const buffer = new ArrayBuffer(NODE_BYTES);
    const seen = { rgbBits: 8, rgbBitsKnown: false, ranges: new Map() };
    return {
      buffer,
      bytes: NODE_BYTES,
      count: pointCount,
      positions: new Float32Array(buffer),
      columns: new Map(),
      rgbBits: 8,
      extent: Float64Array.of(x, y, z, x, y, z),
      seen,
    };
  },
};

const turn = () => new Promise((resolve) => setImmediate(resolve));
const share = (sorted, part) => sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))];

/**
 * The octree of a country of 1.4 million nodes, with everything but decoding: time of a frame's choice of nodes, once
 * all pages of the hierarchy are here; and 500 random flights, with the memory after each fifty. Then flights over a
 * scan with decoding.
 */
export async function bench(root) {
  const next = random(20261122);
  return [...(await still(next)), ...(await flights(next)), ...(await decodingFlights(root, next))];
}

async function openCountry(limits) {
  const crs = "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m";
  return PointCloud.fromUrl(countrySource(), {
    crs,
    vertical: "ellipsoidal",
    executor,
    limits: { ...LIMITS, ...limits },
  });
}

/** A pose over the country; the farther up, the more of it is in sight. */
function pose(next, margin = 0.1) {
  const inside = () => margin + (1 - 2 * margin) * next();
  return {
    ...{ x: CORNER[0] + EDGE * inside(), y: CORNER[1] + EDGE * inside() },
    ...{ height: 100 * 100 ** next(), heading: 2 * Math.PI * next(), pitch: -0.2 - 1.3 * next() },
  };
}

/** Views that see fewer nodes are left out: what a frame costs at all would count for them. */
const LEAST_VISIBLE = 300;

/** The choice of nodes alone. */
async function still(next) {
  const cloud = await openCountry({ knownNodes: Number.POSITIVE_INFINITY });
  const options = { maximumScreenSpaceError: 0.8 };
  await readAllPages(cloud);
  const rows = [];
  for (const [name, budget] of [
    ["screen-space error", Number.POSITIVE_INFINITY],
    ["budget of 5 M points", 5_000_000],
  ]) {
    const first = [];
    const again = [];
    let visible = 0;
    for (let view = 0; view < 40; view++) {
      const seen = viewFrom(cloud, pose(next));
      const timed = (into) => {
        const began = performance.now();
        const { nodes } = cloud.stream.update(cloud, seen, { ...options, pointBudget: budget });
        if (nodes.length >= LEAST_VISIBLE) into.push(((performance.now() - began) / nodes.length) * 1000);
        visible = Math.max(visible, nodes.length);
      };
      timed(first);
      for (let repeat = 0; repeat < 5; repeat++) timed(again);
      await turn();
    }
    for (const [which, times] of [
      ["first sight", first],
      ["again", again],
    ]) {
      times.sort((a, b) => a - b);
      rows.push({
        what: `update, ${name}, ${which}`,
        "nodes known": cloud.nodeCount,
        "most visible": visible,
        "ms per 1,000 visible, median": +share(times, 0.5).toFixed(2),
        "95 %": +share(times, 0.95).toFixed(2),
      });
    }
  }
  cloud.destroy();
  return rows;
}

/** Brings the whole hierarchy in, page by page. */
async function readAllPages(cloud) {
  for (let index = 0; index < 1024; index++) {
    await cloud.loadNode({ depth: 10, x: (index % 32) * 32, y: Math.floor(index / 32) * 32, z: 0 });
  }
  if (cloud.nodeCount !== NODES) throw new Error(`${cloud.nodeCount} nodes of ${NODES}`);
}

/** Random flights with what the layer keeps by default. */
async function flights(next) {
  const cloud = await openCountry();
  const options = { maximumScreenSpaceError: 2, pointBudget: 3_000_000 };
  const rows = [];
  let frames = [];
  let loaded = 0;
  let evicted = 0;
  cloud.stream.subscribe({ nodeLoaded: () => loaded++, nodeEvicted: () => evicted++ });
  const path = flight(() => pose(next), FRAMES);
  for (let frame = 1; frame <= FLIGHTS * FRAMES; frame++) {
    const view = viewFrom(cloud, path.next().value);
    const began = performance.now();
    cloud.stream.update(cloud, view, options);
    frames.push(performance.now() - began);
    await turn();
    await turn();
    if (frame % (50 * FRAMES) !== 0) continue;
    const { heapUsed, arrayBuffers } = await memoryInUse();
    frames.sort((a, b) => a - b);
    rows.push({
      what: `flights to ${frame / FRAMES}`,
      "nodes known": cloud.nodeCount,
      "nodes loaded": loaded,
      "nodes given up": evicted,
      "vertices MiB": mebibytes(arrayBuffers),
      "heap MiB": mebibytes(heapUsed),
      "frame ms, median": +share(frames, 0.5).toFixed(2),
      "99 %": +share(frames, 0.99).toFixed(2),
      most: +frames.at(-1).toFixed(1),
    });
    frames = [];
  }
  cloud.destroy();
  return rows;
}
