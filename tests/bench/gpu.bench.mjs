import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { loadavg, tmpdir } from "node:os";
import { join } from "node:path";
import { openScanPage, SCAN, tellProcessorTime } from "./accuracy/rendering-browser.mjs";
import { converted } from "./converted.mjs";
import { writeReport } from "./gpu/report.mjs";

/** Sets of effects, by name. */
const STYLES = {
  fixed: {},
  adaptive: { size: "adaptive", shape: "disc" },
  "Eye-Dome Lighting": { eyeDomeLighting: true },
  splats: { splats: true },
};

/** What is drawn where nothing is asked for: in software a few points only. */
const SOFTWARE = { points: [50_000, 200_000], size: { width: 960, height: 540 }, frames: 11 };
const CARD = {
  points: [1_000_000, 2_000_000, 5_000_000, 10_000_000],
  size: { width: 1920, height: 1080 },
  frames: 31,
};

/**
 * How long a frame takes, in Cesium with the layer and beside it the same points by plain `gl.POINTS`, in one run and in
 * turns: only their ratios count. In software by the processor's time, which whoever else is on the machine disturbs less. Writes docs/bench/frames.json, .svg and .md.
 *
 * @param {{ card?: boolean, points?: number[] }} options
 */
export async function bench(root, { card = false, points } = {}) {
  const scan = join(root, "../shared/data/autzen.laz");
  if (!existsSync(scan)) return [{ note: "autzen.laz is not in ../shared/data: skipped" }];
  const plan = { ...(card ? CARD : SOFTWARE), ...(points && { points }) };
  const folder = mkdtempSync(join(tmpdir(), "groma-gpu-"));
  try {
    const source = join(root, "tests/bench/gpu");
    const graphics = card ? "card" : "software";
    const { page, setting, close } = await openScanPage(
      root,
      source,
      converted(root, scan),
      folder,
      graphics,
    );
    try {
      if (!card) await tellProcessorTime(page);
      const renderer = await page.evaluate(
        ([scan, size, card]) => {
          window.gpu = new window.Gpu(scan, size, card);
          return window.gpu.renderer;
        },
        [SCAN, plan.size, card],
      );
      const about = { setting, renderer, card, size: plan.size, frames: plan.frames, load: loadavg()[0] };
      const rows = [];
      for (const points of plan.points) {
        for (const [style, given] of Object.entries(STYLES)) {
          for (const logDepth of style === "fixed" ? [true, false] : [true]) {
            const asked = { points, style: given, logDepth, frames: plan.frames };
            rows.push({
              style,
              logDepth,
              ...(await page.evaluate((asked) => window.gpu.measure(asked), asked)),
            });
          }
        }
      }
      writeReport(root, about, rows);
      return rows.map(row);
    } finally {
      await close();
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
}

function row({ style, logDepth, points, nodes, frame, script, still, empty, plain }) {
  const figure = (milliseconds) => Number(milliseconds.toFixed(2));
  return {
    style: logDepth ? style : `${style}, linear depth`,
    points,
    nodes,
    ...{ ms: figure(frame), script: figure(script), still: figure(still), empty: figure(empty) },
    plain: figure(plain),
    "× plain": figure(frame / plain),
  };
}
