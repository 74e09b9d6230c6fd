import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { length } from "./chart.mjs";
import { FRAMES, measureBudgets, measureEffects, measureWidths, POSE, pointsInSight } from "./rendering.mjs";
import { openScene } from "./rendering-browser.mjs";
import { renderingChart } from "./rendering-chart.mjs";
import { percent, points } from "./rendering-figures.mjs";
import { measureStorage, STORAGES } from "./rendering-storage.mjs";
import { digits, markdownTable } from "./table.mjs";

const TITLE = "Drawing: error against time and bytes";

/** Metres: the tolerance of a data set that names none. */
const TOLERANCE = 0.001;

/** Bytes of vertices that the page may keep: more than all points of the scan take. */
const CACHE = 2 ** 31;

/** What drawing costs, by effect, budget and storage of vertices, on a real scan in a real browser, where that is there. */
export async function renderingReport(root) {
  const scan = join(root, "../shared/data/autzen.laz");
  if (!existsSync(scan)) {
    console.log("rendering: autzen.laz is not in ../shared/data: left out");
    return undefined;
  }
  const folder = mkdtempSync(join(tmpdir(), "groma-rendering-"));
  try {
    const file = join(folder, "scan.copc.laz");
    const convert = [join(root, "converter/dist/main.js"), "convert", scan, file];
    execFileSync(process.execPath, convert, { stdio: "pipe" });
    return await reportOn(root, file, folder);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** @param {string} file COPC @param {string} folder for what is built */
export async function reportOn(root, file, folder, frames = FRAMES) {
  const { rows: storage, step } = await measureStorage(file);
  const scene = await openScene(root, file, folder, POSE, CACHE);
  try {
    const inSight = await pointsInSight(scene.page);
    const measured = await measureEffects(scene.page, frames.effects);
    const effects = measured.map(({ picture, ...row }) => row);
    const widths = await measureWidths(scene.page);
    const sweeps = (await measureBudgets(scene.page, frames.sweeps)).map(({ ratio, ...row }) => ({
      ...row,
      time: ratio,
    }));
    if (scene.watch.errors.length > 0) throw new Error(`the page failed: ${scene.watch.errors.join("; ")}`);
    const part = (name) => sweeps.filter((row) => row.part === name);
    const parts = { effects, widths, budget: part("budget"), spacing: part("spacing"), storage };
    const pictures = measured.flatMap(({ effect, picture }) => (picture ? [{ effect, ...picture }] : []));
    return {
      title: TITLE,
      text: describe(parts, inSight, step),
      svg: renderingChart(
        { ...parts, storage: storage.filter(({ storage }) => storage !== "drawn") },
        TOLERANCE,
        TITLE,
      ),
      table: tables(parts, pictures),
      packages: scene.setting,
      how: HOW,
      rows: [...effects, ...widths, ...sweeps, ...storage],
      files: pictures.map(({ name, data }) => [`rendering-${name}.jpg`, Buffer.from(data, "base64")]),
    };
  } finally {
    await scene.close();
  }
}

const HOW =
  "Times are medians of frames, each ended by reading a pixel back; the two that are compared take turns in one page, and " +
  "ratios are medians over frames that followed each other: they count, absolute times depend on the machine and what " +
  "else runs on it. WebGL runs in software here, on the CPU: on a GPU vertices and passes cost in another proportion.";

function describe({ effects, budget }, inSight, step) {
  const nothing = effects[0];
  const low = budget.find((row) => row.budget === 100_000);
  const all = budget.find((row) => row.budget === "none");
  const times = (row) => `${row.ratio.toFixed(2)} ×`;
  const find = (name) => effects.find(({ effect }) => effect.startsWith(name));
  return (
    "The Autzen scan (10.7 million points, airborne) from one place, 640 × 400 pixels. What could be seen is a picture of " +
    `full density: all ${points(inSight)} points in sight, 1.5 px wide, four samples per pixel. Differences are ` +
    "root mean squares over all channels, in steps of 255, and shares of pixels of which a channel is more than 16 steps " +
    "off.\n\n" +
    "**Effects** are drawn on and off with the layer's defaults otherwise (budget of 1,000,000 points, screen-space error " +
    "of 2 px, points of 2 px). Those that fill what lies between points are held against one picture of full density; " +
    "the others show something else, and are held against one that shows it too. Shapes are compared at adaptive sizes, " +
    `splats with discs. The same picture twice is the noise: ${times(nothing)}. Blended splats take ` +
    `${times(find("blended"))} the frame time, Eye-Dome Lighting ${times(find("Eye-Dome Lighting, 4"))} with four ` +
    `neighbours and ${times(find("Eye-Dome Lighting, 8"))} with eight. ` +
    "A filter draws what it leaves out outside the picture: its points are counted all the same. The scan records no " +
    "classes: the colours are those of one.\n\n" +
    "**Widths** are multiples of the spacing (`spacingFactor`), at the default screen-space error. Holes are the share of " +
    "the pixels inside the outline of full density that show the background, overdraw the fragments per pixel in it. A " +
    "radius of one spacing, factor 2, leaves nothing of a maximal Poisson-disc sample of a surface open.\n\n" +
    "**The budget** is swept without any other limit, the screen-space error without a budget; the default, points of 2 px, " +
    `is 1 on the axis of time. With fixed sizes a tenth of the default budget takes ${low.time.toFixed(2)} × the time at a difference of ` +
    `${low.onRms.toFixed(1)} steps, all points ${all.time.toFixed(2)} × at ${all.onRms.toFixed(1)}: what remains ` +
    "there is that a pixel has one sample, and points 2 px wide.\n\n" +
    "**Storage** is the distance of stored coordinates, as the vertex shader brings them back in float32, from the " +
    "float64 places of the records, at up to six nodes of each level; `drawn` is what the page really draws, float32 from a fit " +
    `that keeps the tolerance of ${length(TOLERANCE)}. One step of the scan's own integers is ${length(step)}.`
  );
}

function tables({ effects, widths, budget, spacing, storage }, pictures) {
  const named = (row, name) => (row.chosen ? `**${name}**` : name);
  const sweep = (row, name, value) => ({
    look: row.look,
    [name]: named(row, value),
    points: points(row.onPoints),
    "ms/frame": digits(row.onMs),
    "× default": row.time.toFixed(2),
    "RMS to full density": row.onRms.toFixed(1),
    "pixels off": percent(row.onWrongPixels),
  });
  return [
    "## Effects",
    markdownTable(effects.map(effectRow)),
    ...pictures.map(
      ({ effect, name }) => `![${effect}](rendering-${name}.jpg)\n\n*${effect}: off, on, full density.*`,
    ),
    "## Widths",
    markdownTable(widths.map(widthRow)),
    "## Point budget",
    markdownTable(
      budget.map((row) =>
        sweep(row, "budget", row.budget === "none" ? "–" : row.budget.toLocaleString("en")),
      ),
    ),
    "## Screen-space error",
    markdownTable(spacing.map((row) => sweep(row, "px", String(row.pixels)))),
    "## Vertex storage",
    markdownTable(storageRows(storage)),
  ].join("\n\n");
}

function effectRow(row) {
  const difference = (rms, pixels) => `${rms.toFixed(1)}, ${percent(pixels)}`;
  return {
    effect: row.effect,
    "points off → on": `${points(row.offPoints)} → ${points(row.onPoints)}`,
    "ms off → on": `${digits(row.offMs)} → ${digits(row.onMs)}`,
    "on : off": row.ratio.toFixed(2),
    quartiles: row.ratioQuartiles.map((ratio) => ratio.toFixed(2)).join(" – "),
    "change (RMS, pixels)": difference(row.changeRms, row.changedPixels),
    "to full density, off": difference(row.offRms, row.offWrongPixels),
    "to full density, on": difference(row.onRms, row.onWrongPixels),
  };
}

function widthRow({ look, factor, chosen, holes, overdraw, onRms, onWrongPixels }) {
  const value = factor === undefined ? "–" : String(factor);
  return {
    look,
    factor: chosen ? `**${value}**` : value,
    holes: `${(100 * holes).toFixed(2)} %`,
    overdraw: overdraw.toFixed(1),
    "RMS to full density": onRms.toFixed(1),
    "pixels off": percent(onWrongPixels),
  };
}

/** One per storage and level. */
function storageRows(rows) {
  const kinds = [...STORAGES.map(({ storage }) => storage), "drawn"];
  const levels = [...new Set(rows.map(({ level }) => level))];
  return kinds.flatMap((kind) =>
    levels.map((level) => {
      const nodes = rows.filter((row) => row.storage === kind && row.level === level);
      const [{ storage, bytes, chosen }] = nodes;
      return {
        storage: chosen ? `**${storage}**` : storage,
        "bytes/vertex": String(bytes),
        level: String(level),
        "node edge": length(Math.max(...nodes.map(({ edge }) => edge))),
        nodes: String(nodes.length),
        "greatest error": length(Math.max(...nodes.map(({ worst }) => worst))),
        mean: length(nodes.reduce((sum, { mean }) => sum + mean, 0) / nodes.length),
      };
    }),
  );
}
