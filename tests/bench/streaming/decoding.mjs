import { existsSync } from "node:fs";
import { join } from "node:path";
import { PointCloud, WorkerPool } from "@groma/layer";
import { converted } from "../converted.mjs";
import { viewFrom } from "./camera.mjs";
import { flight } from "./flights.mjs";
import { mebibytes, memoryInUse } from "./memory.mjs";
import { NodeWorkers } from "./node-workers.mjs";
import { serveFile } from "./range-server.mjs";

const FLIGHTS = 500;
const FRAMES = 3;
/** Milliseconds between two frames, in which nodes arrive. */
const INTERVAL = 100;
/** So little is kept that each flight gives up most of what the one before brought. */
const LIMITS = { requests: 8, cacheBytes: 48 * 2 ** 20, knownNodes: 200 };
const TRAVERSAL = { maximumScreenSpaceError: 2, pointBudget: 800_000 };

const sleep = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/**
 * Random flights over Autzen with all that a page does but drawing: Range requests to a server, the layer's own workers
 * with their decoder, placing and packing, records read again; with the memory of all after each fifty flights.
 */
export async function decodingFlights(root, next) {
  const scan = join(root, "../shared/data/autzen.laz");
  if (!existsSync(scan)) return [{ what: "autzen.laz is not in ../shared/data: skipped" }];
  const server = await serveFile(converted(root, scan));
  const workers = new NodeWorkers(import.meta.resolve("@groma/layer/workers/node.worker.js"));
  const executor = new WorkerPool({ size: 2, createWorker: () => workers.create() });
  const cloud = await PointCloud.fromUrl(server.url, { executor, limits: LIMITS });
  try {
    return await fly(cloud, workers, next);
  } finally {
    cloud.destroy();
    executor.destroy();
    await server.close();
  }
}

async function fly(cloud, workers, next) {
  const rows = [];
  let loaded = 0;
  let evicted = 0;
  let records = 0;
  const failures = [];
  cloud.stream.subscribe({
    nodeLoaded: () => loaded++,
    nodeEvicted: () => evicted++,
    nodeFailed: (_, error) => failures.push(error),
  });
  const path = flight(() => poseOver(cloud, next), FRAMES);
  for (let frame = 1; frame <= FLIGHTS * FRAMES; frame++) {
    const { nodes } = cloud.stream.update(cloud, viewFrom(cloud, path.next().value), TRAVERSAL);
    await sleep(INTERVAL);
    if (frame % FRAMES !== 0) continue;
    const node = nodes[Math.floor(next() * nodes.length)];
    if (node) {
      await cloud.readPoint(node, Math.floor(next() * node.pointCount));
      records++;
    }
    if (frame % (50 * FRAMES) !== 0) continue;
    if (failures.length > 0) throw failures[0];
    const { heapUsed, arrayBuffers, rss } = await memoryInUse();
    const theirs = await workers.memory();
    rows.push({
      what: `decoding, flights to ${frame / FRAMES}`,
      ...{ "nodes known": cloud.nodeCount, "nodes loaded": loaded, "nodes given up": evicted },
      "records read": records,
      "cache MiB": mebibytes(cloud.stream.bytes),
      // Node counts what a worker handed over as the worker's still.
      "buffers MiB": mebibytes(arrayBuffers + theirs.arrayBuffers),
      "heap MiB": mebibytes(heapUsed),
      "workers' heap MiB": mebibytes(theirs.heapUsed),
      "WebAssembly MiB": mebibytes(theirs.wasm),
      "rss MiB": mebibytes(rss),
    });
  }
  return rows;
}

/** A pose over the scan, from a few metres above its highest point to where all of it is in sight. */
function poseOver({ boundingBox: { min, max } }, next) {
  const inside = (axis) => min[axis] + (max[axis] - min[axis]) * (0.1 + 0.8 * next());
  const across = Math.max(max[0] - min[0], max[1] - min[1]);
  return {
    ...{ x: inside(0), y: inside(1), height: max[2] + 0.003 * across * 300 ** next() },
    ...{ heading: 2 * Math.PI * next(), pitch: -0.2 - 1.3 * next() },
  };
}
