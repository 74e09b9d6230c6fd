import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { loadavg, tmpdir } from "node:os";
import { join } from "node:path";
import { openScanPage, SCAN } from "./accuracy/rendering-browser.mjs";
import { converted } from "./converted.mjs";
import { CATEGORIES, phasesOf } from "./frames/trace.mjs";
import { writeNodes } from "./gpu/report.mjs";

/** Source coordinates of the middle of what is looked at. */
const AT = [637_290, 851_210, 430];

/** CPU milliseconds beyond which the main thread counts as held. */
const LIMIT = 8;

/**
 * Parts of a frame that are not of the layer's own making: Cesium's, what WebGL takes, and garbage collections, which a
 * browser begins where it likes.
 */
const FOREIGN = ["scene", "GL data", "GL programs", "garbage"];

/**
 * How long the main thread is held by the layer while a scan is loaded, flown over, restyled and cut: in each frame by
 * its update and what the application calls, between frames by what workers send. In system Chromium with WebGL in
 * software, where calls of WebGL take what a driver would not: they are told apart. Before that, what a thousand nodes and
 * more take of a frame, which goes into docs/bench/frames.md.
 */
export async function bench(root) {
  const scan = join(root, "../shared/data/autzen.laz");
  if (!existsSync(scan)) return [{ note: "autzen.laz is not in ../shared/data: skipped" }];
  const folder = mkdtempSync(join(tmpdir(), "groma-frames-"));
  try {
    const { page, setting, watch, close } = await openScanPage(
      root,
      join(root, "tests/bench/frames"),
      converted(root, scan),
      folder,
    );
    try {
      console.log(`${setting}, load ${loadavg()[0].toFixed(1)}`);
      const browser = page.context().browser();
      const traced = async (work) => {
        await browser.startTracing(page, { categories: CATEGORIES });
        const result = await page.evaluate(work, [SCAN, AT]);
        const phases = phasesOf(await browser.stopTracing());
        if (watch.errors.length > 0) throw new Error(`the page failed: ${watch.errors.join("; ")}`);
        return { result, phases };
      };
      const load = loadavg()[0];
      const many = await traced(([scan, at]) => new window.ManyNodes().run(scan, at));
      const nodes = nodesRow(many.result, many.phases);
      writeNodes(root, { setting, load, ...nodes });
      console.table([nodes]);
      const { phases } = await traced(([scan, at]) => new window.Frames().run(scan, at));
      console.table(phases.map(parts));
      return [...phases.map(row), nodes];
    } finally {
      await close();
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/**
 * What many nodes take of a frame: CPU milliseconds of the page's thread, medians of all frames, all that Cesium does for it
 * included, and microseconds for each node, without what the same frame takes where the layers are hidden.
 */
function nodesRow({ clouds, nodes, points }, phases) {
  const milliseconds = (name) => {
    const { frames } = phases.find((phase) => phase.name === name);
    const times = frames.map(({ cpu }) => Object.values(cpu).reduce((sum, time) => sum + time, 0));
    return times.sort((a, b) => a - b)[Math.floor(times.length / 2)];
  };
  const [moving, still, empty] = ["moving", "still", "empty"].map(milliseconds);
  const perNode = (time) => Number(((1000 * (time - empty)) / nodes).toFixed(2));
  const precise = (time) => Number(time.toFixed(2));
  return {
    ...{ phase: "many nodes", clouds, nodes, points },
    ...{ "moving, ms": precise(moving), "still, ms": precise(still), "empty, ms": precise(empty) },
    ...{ "moving, µs a node": perNode(moving), "still, µs a node": perNode(still) },
  };
}

/** CPU milliseconds of a frame that are the layer's own. */
function own({ cpu }) {
  return Object.entries(cpu).reduce((sum, [part, time]) => (FOREIGN.includes(part) ? sum : sum + time), 0);
}

/** CPU milliseconds, and of WebGL what the thread waited. */
function row({ name, frames, messages }) {
  const times = frames.map(own).sort((a, b) => a - b);
  const share = (part) => times[Math.min(times.length - 1, Math.floor(part * times.length))];
  const longest = (part) => figure(Math.max(...frames.map(({ wall }) => wall[part] ?? 0)));
  return {
    phase: name,
    updates: times.length,
    median: figure(share(0.5)),
    "95 %": figure(share(0.95)),
    longest: figure(times.at(-1)),
    [`over ${LIMIT} ms`]: times.filter((time) => time > LIMIT).length,
    "garbage, longest": figure(Math.max(...frames.map(({ cpu }) => cpu.garbage ?? 0))),
    "GL data, wall": longest("GL data"),
    "GL programs, wall": longest("GL programs"),
    messages: messages.length,
    "longest message": figure(Math.max(0, ...messages)),
  };
}

/** The longest CPU milliseconds of each part in any frame of a phase. */
function parts({ name, frames }) {
  const names = [...new Set(frames.flatMap(({ cpu }) => Object.keys(cpu)))];
  const longest = names.map((part) => [part, figure(Math.max(...frames.map(({ cpu }) => cpu[part] ?? 0)))]);
  return { phase: name, ...Object.fromEntries(longest) };
}

function figure(milliseconds) {
  return Number(milliseconds.toFixed(1));
}
