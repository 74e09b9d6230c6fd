import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { loadavg, tmpdir } from "node:os";
import { join } from "node:path";
import { openScanPage, SCAN } from "./accuracy/rendering-browser.mjs";
import { converted } from "./converted.mjs";

/** Source coordinates of the middle of what is looked at. */
const AT = [637_290, 851_210, 430];

/** Measurements of a run, whatever its length. */
const SAMPLES = 40;

/** Share by which the last quarter of a run may lie above the second. */
const FLAT = 0.1;

const minute = 60_000;

/**
 * What a layer keeps after hours of flights and of other styles, filters and clips: JavaScript's heap and array buffers
 * after a garbage collection, bytes, objects and programs on the GPU, each time in the same view and style. In system
 * Chromium with WebGL in software, which draws no points. The first quarter fills what is to be filled; then all is to
 * stay.
 *
 * @param {string} root of the project
 * @param {{ minutes?: number }} options how long it runs; default: two hours
 */
export async function bench(root, { minutes = 120 } = {}) {
  const scan = join(root, "../shared/data/autzen.laz");
  if (!existsSync(scan)) return [{ note: "autzen.laz is not in ../shared/data: skipped" }];
  const folder = mkdtempSync(join(tmpdir(), "groma-soak-"));
  try {
    const source = join(root, "tests/bench/soak");
    const { page, setting, watch, close } = await openScanPage(root, source, converted(root, scan), folder);
    try {
      console.log(`${setting}, load ${loadavg()[0].toFixed(1)}, ${minutes} minutes`);
      const devtools = await page.context().newCDPSession(page);
      await page.evaluate(
        async ([scan, at]) => {
          window.soak = await window.Soak.open(scan, at);
        },
        [SCAN, AT],
      );
      const samples = [];
      for (let at = 0; at < SAMPLES; at++) {
        const share = (minutes * minute) / SAMPLES;
        const state = await page.evaluate((milliseconds) => window.soak.run(milliseconds), share);
        samples.push({ ...state, ...(await memory(devtools)) });
        if (at % 5 === 4) console.log(JSON.stringify(samples.at(-1)));
      }
      if (watch.errors.length > 0) throw new Error(`the page failed: ${watch.errors.join("; ")}`);
      return [...rows(samples), { measured: "rounds of changes", last: samples.at(-1).rounds }];
    } finally {
      await close();
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** MB of the page's own thread once all garbage is gone. */
async function memory(devtools) {
  // What only finalisers let go of goes with a second round.
  for (let round = 0; round < 2; round++) await devtools.send("HeapProfiler.collectGarbage");
  const { usedSize, backingStorageSize = 0 } = await devtools.send("Runtime.getHeapUsage");
  return { heap: usedSize / 1e6, arrayBuffers: backingStorageSize / 1e6 };
}

function rows(samples) {
  const measured = {
    "heap, MB": ({ heap }) => heap,
    "array buffers, MB": ({ arrayBuffers }) => arrayBuffers,
    "GPU, MB": ({ gpuBytes }) => gpuBytes / 1e6,
    "GPU objects": ({ gpuObjects }) => Object.values(gpuObjects).reduce((sum, count) => sum + count, 0),
    programs: ({ gpuObjects }) => gpuObjects.programs,
  };
  return Object.entries(measured).map(([name, of]) => {
    const values = samples.map(of);
    const mean = (from, to) => {
      const part = values.slice(from * values.length, to * values.length);
      return part.reduce((sum, value) => sum + value, 0) / part.length;
    };
    const [early, late] = [mean(0.25, 0.5), mean(0.75, 1)];
    const growth = late / early - 1;
    return {
      measured: name,
      first: figure(values[0]),
      "second quarter": figure(early),
      "last quarter": figure(late),
      greatest: figure(Math.max(...values)),
      growth: `${(100 * growth).toFixed(1)} %`,
      flat: growth <= FLAT,
    };
  });
}

function figure(value) {
  return Number(value.toFixed(1));
}
