import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { exportLas, exportSections } from "@groma/layer/export";
import { Corridor, CrossSections, stations } from "@groma/layer/tools";
import { converted } from "./converted.mjs";

/** Nothing is kept: what is measured is reading, deciding and making the bytes. */
const nowhere = { write: async () => {}, overwrite: async () => {} };

/**
 * All tasks take turns for so many seconds of the processor, and at least so many rounds; the least time of each counts, once everything
 * is compiled.
 */
const SECONDS = 12;
const ROUNDS = 4;

/**
 * Profiles and cross-sections against decoding alone the nodes that they touch, in one run and by processor time, which whoever else
 * works on the machine hardly changes: bars 1.3 and 1.5. And the export of ten million points within 500 MB.
 */
export async function bench(root) {
  const { openPoints } = await import(join(root, "converter/dist/files/points.js"));
  const rows = [];
  for (const scan of ["vol_total.laz", "autzen.laz"]) {
    const file = join(root, "../shared/data", scan);
    if (!existsSync(file)) continue;
    const { points: origin, close } = await openPoints(converted(root, file), new AbortController().signal);
    const { min, max } = origin.source.boundingBox;
    const at = (x, y) => [min[0] + x * (max[0] - min[0]), min[1] + y * (max[1] - min[1])];
    const width = (max[1] - min[1]) / 20;
    const line = new Corridor([at(0.1, 0.2), at(0.5, 0.7), at(0.9, 0.6)], width);
    const sections = new CrossSections(line, stations(0, line.length, { interval: line.length / 499 }), {
      ...{ left: width / 2, right: width / 2, thickness: line.length / 2000 },
    });
    const tasks = {
      "decoding what the strip touches": () => decode(origin, line),
      "profile, LAS": () => exportLas([{ origin, volume: line, along: line }], nowhere),
      "decoding what 500 sections touch": () => decode(origin, sections),
      "500 sections, LAS in one archive": () =>
        exportSections([{ origin, volume: sections }], nowhere, options(line)),
    };
    const best = await leastTimes(tasks);
    for (const [name, seconds] of Object.entries(best)) {
      const base = name.includes("section")
        ? "decoding what 500 sections touch"
        : "decoding what the strip touches";
      rows.push({ scan, what: name, seconds: round(seconds), ratio: round(seconds / best[base]) });
    }
    await close();
    if (scan === "autzen.laz") rows.push({ scan, ...exported(root, converted(root, file)) });
  }
  return rows;
}

const UNIT = { text: "m", size: 1 };
const options = (line) => ({ line, facts: { title: "bench", unit: UNIT, heightUnit: UNIT }, files: ["las"] });

/** Says on standard error how much memory a process held at most, in kilobytes. */
const TELL = 'data:text/javascript,process.on("exit",()=>console.error(process.resourceUsage().maxRSS))';

/** Exports all points by the command, in a process of its own that does nothing else. */
function exported(root, file) {
  const folder = mkdtempSync(join(tmpdir(), "groma-bench-"));
  const groma = join(root, "converter/dist/main.js");
  const all = ["clip", file, "--heights=-1e9,1e9", "--out", join(folder, "all.las"), "--progress", "json"];
  const began = performance.now();
  const run = spawnSync(process.execPath, ["--import", TELL, groma, ...all], { encoding: "utf8" });
  const seconds = round((performance.now() - began) / 1000);
  rmSync(folder, { recursive: true });
  if (run.status !== 0) throw new Error(run.stderr);
  const { points } = JSON.parse(run.stdout.trim().split("\n").at(-1));
  const megabytes = Math.round(Number(run.stderr.trim().split("\n").at(-1)) / 1024);
  return { what: `all ${points} points, LAS, by the command; ${megabytes} MB at most`, seconds };
}

/** Reads the nodes that a volume touches, and asks nothing of their points. */
async function decode(origin, volume) {
  const touched = { toBox: (box) => volume.toBox(box), contains: () => false };
  let count = 0;
  for await (const { records } of origin.query({ volume: touched }).batches()) count += records.count;
  return count;
}

async function leastTimes(tasks) {
  const best = Object.fromEntries(Object.keys(tasks).map((name) => [name, Number.POSITIVE_INFINITY]));
  const spent = () => process.cpuUsage().user / 1e6;
  const end = spent() + SECONDS;
  for (let turn = 0; turn < ROUNDS || spent() < end; turn++) {
    for (const [name, task] of Object.entries(tasks)) {
      const before = process.cpuUsage();
      await task();
      const { user, system } = process.cpuUsage(before);
      best[name] = Math.min(best[name], (user + system) / 1e6);
    }
  }
  return best;
}

const round = (value) => Number(value.toPrecision(3));
